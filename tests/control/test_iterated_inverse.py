"""The inverse by successive correction: the law answers its input with what was wanted, or it is said why not."""

from importlib import import_module

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.control.inverse import BoucWenInverse
from hysteresis_bench.control.iterated_inverse import IteratedInverse
from hysteresis_bench.fit.preparation import AS_IT_IS, Preparation
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 1.0, 700)
DRIVE = np.sin(19.0 * TIME) + 0.4 * np.sin(43.0 * TIME)
RECORD = Record(TIME, DRIVE, 2.0 * DRIVE)


def inverse(name, values, effects=(), preparation=AS_IT_IS):
    model = registry.build("models", name)
    return IteratedInverse(System(model, registry.build_effects(model, effects)), np.asarray(values), preparation)


def in_the_box(name, share=0.5):
    box = registry.build("models", name).box([RECORD])
    return Space(tuple(box)).from_unit(np.full((len(box), 1), share))[:, 0]


BOUC_WEN = (0.4, 1.1, 0.2, 1.7)


def test_it_is_the_exact_inverse_of_bouc_wen():
    wanted = 1.2 * DRIVE
    found, cut = inverse("bouc-wen", BOUC_WEN).input_for(wanted)
    assert not cut.any()
    assert found == pytest.approx(BoucWenInverse(*BOUC_WEN).input_for(wanted), abs=1e-8)


@pytest.mark.parametrize("name", ["prandtl-ishlinskii", "energy-based", "ferroelectric", "free-energy"])
def test_the_law_answers_with_what_was_wanted(name):
    built = inverse(name, in_the_box(name, 0.7))
    wanted = built._output(0.8 * DRIVE)
    found, _ = built.input_for(wanted)
    assert np.max(np.abs(built._output(found) - wanted)) <= 1e-9 * np.ptp(wanted)


def test_offset_flip_and_static_effects_are_undone():
    built = inverse("bouc-wen", (*BOUC_WEN, 0.7), ["bias"], Preparation(input_offset=3.0, flip=True))
    plain = inverse("bouc-wen", BOUC_WEN)
    found, _ = built.input_for(1.2 * DRIVE + 0.7)
    assert found == pytest.approx(3.0 - plain.input_for(1.2 * DRIVE)[0], abs=1e-8)


def test_the_limit_cuts_and_says_where():
    built = inverse("bouc-wen", BOUC_WEN)
    free, _ = built.input_for(1.2 * DRIVE)
    limit = 0.8 * float(np.max(np.abs(free)))
    found, cut = built.input_for(1.2 * DRIVE, limit)
    assert np.max(np.abs(found)) <= limit * (1.0 + 1e-12)
    assert cut.any()
    assert not cut[: int(np.argmax(np.abs(free) > limit))].any()
    left = built._output(found) - 1.2 * DRIVE
    assert np.max(np.abs(left[~cut])) < 1e-9


@pytest.mark.parametrize(
    ("name", "values", "wanted", "said"),
    [
        ("jiles-atherton", (1e-4, 900.0, 300.0, 1e6, 0.2), 1e30 * DRIVE, "does not reach"),
        ("bouc-wen", (0.2, 1.0, 0.0, -1.0), DRIVE, "falls where the input rises"),
    ],
)
def test_where_there_is_no_inverse_it_is_said(name, values, wanted, said):
    built = inverse(name, values)
    with pytest.raises(ValueError, match=said):
        built.input_for(wanted)


def test_a_law_that_depends_on_the_rate_is_refused():
    with pytest.raises(ValueError, match="depends on the rate"):
        inverse("lugre", in_the_box("lugre", 0.8)).input_for(0.1 * DRIVE)


def test_where_the_output_hardly_moves_a_close_input_is_enough(monkeypatch):
    """Within its clearance a friction device falls a little as its input rises: no iteration ends exactly there."""
    names = [parameter.name for parameter in registry.build("models", "maxwell-slip").parameters]
    values = {"radius": 0.35, "gap": 0.001, "slope": -0.9, "k4": 800.0, "k8": 200.0}
    built = inverse("maxwell-slip", [values.get(name, 0.0) for name in names])
    wanted = 20.0 * DRIVE * np.clip(3.0 * TIME, 0.0, 1.0) ** 3
    monkeypatch.setattr(import_module(IteratedInverse.__module__), "ITERATIONS", 1000)
    found, _ = built.input_for(wanted)
    assert np.max(np.abs(built._output(found) - wanted)) <= 1e-3 * np.ptp(wanted)


def test_a_law_that_is_steepest_after_a_reversal_is_inverted():
    """The ramp does not show how steep it is: the correction would go round in a circle."""
    names = [parameter.name for parameter in registry.build("models", "maxwell-slip").parameters]
    values = {"radius": 0.4, "slope": 0.5, **{f"k{k}": 200.0 / k for k in range(2, 17, 2)}}
    built = inverse("maxwell-slip", [values.get(name, 0.0) for name in names])
    wanted = 17.0 * np.sin(19.0 * TIME) * np.clip(3.0 * TIME, 0.0, 1.0) ** 3
    found, _ = built.input_for(wanted)
    assert np.max(np.abs(built._output(found) - wanted)) <= 1e-9 * np.ptp(wanted)

"""A law of many parameters is solved for: one answer a set of effects, and errors of what is left out like those of a
fit to the rest."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import SmoothFitter, fitter_of
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.signals import Record
from tests.plugins.truths import simulated

TIME = np.linspace(0.0, 2.0, 120)
OFFSET = frozenset({registry.RECORD_OFFSET})


def record(amplitude: float) -> Record:
    u = amplitude * np.sin(2.0 * np.pi * TIME)
    law = registry.build("models", "energy-based", {})
    truth = {"a": 0.8, "coupling": 0.2, "pinning": 0.6, "spread": 0.5, "reversible": 0.2, "slope": 0.05, "M_s": 1.5}
    y = simulated(law, u, TIME, **truth) + 0.02 * TIME
    return Record(TIME, u, y + 2e-3 * np.random.default_rng(1).standard_normal(y.size), name=f"{amplitude}")


@pytest.fixture(scope="module")
def fitter():
    law = registry.build("models", "preisach-hats", {"plays": 4, "pieces": 8})
    return fitter_of(Stack(law, tuple(record(amplitude) for amplitude in (1.0, 1.5, 2.0))), 0)


def test_a_law_asks_for_its_fitter(fitter):
    assert isinstance(fitter, SmoothFitter)
    assert type(fitter_of(Stack(registry.build("models", "dahl", {}), fitter.stack.records), 0)) is Fitter


def test_a_set_of_effects_has_one_answer(fitter):
    bare = fitter.bare(OFFSET)
    drifting = fitter.extended(bare, "drift")
    assert fitter.reduced(drifting, "drift") is bare
    assert fitter.followed(drifting) is fitter.from_anywhere(drifting.names)
    assert drifting.rmse < bare.rmse
    assert fitter.unseen(drifting) is drifting.left_out
    assert fitter.fitted_values(bare) < len(bare.values)
    assert fitter.test(bare, drifting).p < 1e-3
    _, values = fitter.fitted(drifting)
    left = fitter.errors(drifting.names, values)
    np.testing.assert_allclose(left, drifting.residuals, atol=1e-12)
    np.testing.assert_allclose(fitter.polished(drifting), values, rtol=1e-5, atol=1e-8)


def test_what_is_left_out_is_predicted_from_the_rest(fitter):
    bare, records = fitter.bare(OFFSET), fitter.stack.records
    size = bare.residuals.size
    none = Blocks(np.zeros(size, dtype=int), np.ones(size, dtype=int), 1)
    np.testing.assert_allclose(fitter.errors_without(bare, records, none)[:, 0], bare.residuals, atol=1e-6)
    own = records[1].measured.size
    number = np.repeat(np.arange(3), own)
    left = fitter.errors_without(bare, records, Blocks(number, number, 3))
    np.testing.assert_allclose(fitter.apart(bare), left[np.arange(size), number])
    turned = fitter.errors_without(bare, records[::-1], Blocks(number, number, 3))
    np.testing.assert_allclose(turned[own : 2 * own, 1], left[own : 2 * own, 1], atol=1e-8)


def test_an_effect_behind_which_the_weights_are_not_linear_is_not_tried(fitter):
    possible, impossible = fitter.stack.candidates()
    assert "drift" in possible
    assert "many weights" in impossible["saturation"]
    assert "output-curve" not in fitter.stack.free_forms()


def test_an_effect_is_needed_however_smooth_the_density_is_without_it(fitter):
    """Without a constant far larger than the loops a smooth density is the best one: what it has less of freedom does
    not count against the constant."""
    far = replace(fitter.stack, records=tuple(replace(one, output=one.output + 30.0) for one in fitter.stack.records))
    far = fitter_of(far, 0)
    none, constant = far.from_anywhere(frozenset()), far.from_anywhere(frozenset({registry.COMMON_OFFSET}))
    assert constant.rmse < 0.1 * none.rmse
    assert far.test(none, constant).p < 1e-6
    assert far.test(none, constant).added == 1

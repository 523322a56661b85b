"""Are records periods of a settled loop? Found on most of them, at rest where they began at rest."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from hysteresis_bench import compare, diagnose, fit, registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.fit.checks.settled_periods import SAID, settled_periods, unsettled
from hysteresis_bench.fit.fitting import FitOptions
from hysteresis_bench.fit.settling import passed
from hysteresis_bench.signals import Dataset, Record

LAWS = (
    "jiles-atherton-clamped",
    "energy-based",
    "preisach",
    "prandtl-ishlinskii-modified",
    "bouc-wen",
    "dahl",
    "lugre",
)
SAMPLES, PASSES = 200, 8
PHASE = np.arange(SAMPLES + 1) / SAMPLES
DRIVES = {
    "cosine": lambda phase: -np.cos(2.0 * np.pi * phase),
    "triangle": lambda phase: 2.0 * np.abs(2.0 * ((phase + 0.5) % 1.0) - 1.0) - 1.0,
    "one-sided": lambda phase: 0.5 - 0.5 * np.cos(2.0 * np.pi * phase),
}


def period(law: str, drive: str, noise: float, *, settled: bool, seed: int = 1, turn: float = 0.0) -> Record:
    """One period of the law's own example; turn : of a period, by which it begins later"""
    model = registry.build("models", law)
    system, example = System(model), model.example
    values = np.array([[example.parameters[q.name]] for q in system.parameters])
    passes = PASSES if settled else 1
    time = np.arange(passes * SAMPLES + 1) / SAMPLES
    u = example.amplitude * DRIVES[drive](time + turn)
    y = system.simulate(Record(time, u, None).signal, values)[-SAMPLES - 1 :, 0]
    noisy = y + noise * np.ptp(y) * np.random.default_rng(seed).standard_normal(y.size)
    return Record(PHASE, u[-SAMPLES - 1 :], noisy, name=f"{law}, {drive}")


def test_most_settled_periods_are_found():
    found = [
        settled_periods([period(law, drive, noise, settled=True)])
        for law, drive, noise in product(LAWS, DRIVES, (0.003, 0.01))
    ]
    assert np.mean(found) > 0.9


def test_what_began_at_rest_is_begun_at_rest_where_it_matters():
    for law, drive, noise in product(LAWS, DRIVES, (0.003, 0.01)):
        rest, settled = (period(law, drive, 0.0, settled=settled) for settled in (False, True))
        differ = np.sqrt(np.mean((rest.output - settled.output) ** 2)) / np.ptp(rest.output)
        noisy = period(law, drive, noise, settled=False)
        assert not settled_periods([noisy]) or differ < 2.0 * noise, (law, drive, noise, differ)


@pytest.mark.parametrize("turn", [0.25, 0.1])
def test_a_record_that_begins_between_reversals_tells_nothing(turn):
    assert not settled_periods([period("dahl", "cosine", 0.003, settled=True, turn=turn)])


def test_what_has_no_loop_needs_no_passes():
    u = DRIVES["cosine"](PHASE)
    noise = 0.003 * np.random.default_rng(2).standard_normal(u.size)
    assert not settled_periods([Record(PHASE, u, np.tanh(2.0 * u) + noise)])


def test_one_record_that_is_none_leaves_all_at_rest_unless_asked():
    loop = period("dahl", "cosine", 0.003, settled=True)
    ramp = Record(PHASE, PHASE, PHASE**2, name="ramp")
    assert settled_periods([loop])
    assert not settled_periods([loop, ramp])
    assert not settled_periods([loop.skip(0.1)])
    assert not settled_periods([loop], asked=False)
    assert settled_periods([ramp], asked=True)


@pytest.mark.parametrize("law", LAWS)
def test_an_output_that_does_not_come_back_is_told_where_loops_are_to_settle(law):
    loop = period(law, "cosine", 0.003, settled=True, turn=0.25)
    moved = replace(loop, output=loop.output + 0.1 * np.ptp(loop.output) * PHASE, name="moved")
    assert unsettled([loop], asked=True) == ()
    (said,) = unsettled([loop, moved], asked=True)
    assert loop.name not in said
    share = float(said.split("moved (")[1].split(" %")[0])
    assert share == pytest.approx(10.0, abs=2.0)
    assert unsettled([moved], asked=None) == unsettled([moved], asked=False) == ()


@pytest.mark.filterwarnings("error")
def test_what_cannot_tell_says_nothing_of_an_output_that_does_not_come_back():
    one = Record(PHASE[:1], PHASE[:1], PHASE[:1])
    flat = Record(PHASE, np.sin(2 * np.pi * PHASE), np.ones(PHASE.size))
    assert unsettled([one, flat], asked=True) == unsettled([one, flat], asked=None) == ()


@pytest.fixture
def moved():
    """A loop whose end lies above its beginning."""
    loop = period("dahl", "cosine", 0.003, settled=True)
    return Dataset((replace(loop, output=loop.output + 0.1 * np.ptp(loop.output) * PHASE),))


ASKED = DiagnosisOptions(jobs=1, settle=True, laws=("dahl",))


def test_fit_and_compare_say_so(moved):
    (said,) = unsettled(moved.records, asked=True)
    assert said in fit(moved, "dahl", options=FitOptions(budget=600, settle=True)).warnings
    assert said in compare(moved, ASKED.laws, options=ASKED).words


@pytest.mark.long
@pytest.mark.parametrize("model", ["dahl", None])
def test_diagnose_says_so_once(moved, model):
    (said,) = unsettled(moved.records, asked=True)
    assert " ".join(diagnose(moved, model, options=ASKED).warnings).count(said) == 1


def test_a_settled_period_is_fitted_and_predicted_as_one():
    loop = period("dahl", "cosine", 0.003, settled=True)
    rest = Record(PHASE, PHASE, np.zeros(PHASE.size), name="open")
    asked = FitOptions(budget=600)
    own, told = (fit(Dataset((loop,)), "dahl", options=one) for one in (asked, replace(asked, settle=True)))
    left = fit(Dataset((loop,)), "dahl", options=replace(asked, settle=False))
    assert own.model.preparation.settle == told.model.preparation.settle > 0
    assert np.array_equal(own.model.values, told.model.values)
    assert SAID in own.notes
    assert SAID not in told.notes
    assert left.model.preparation.settle == 0
    assert left.records.rmse[0] > 2.0 * own.records.rmse[0]
    predicted = own.model.predict(Dataset((loop, rest)))
    assert np.sqrt(np.mean((predicted.records[0].output - loop.output) ** 2)) == pytest.approx(own.records.rmse[0])
    with_open = fit(Dataset((loop, rest), ("open",)), "dahl", options=asked)
    assert np.allclose(with_open.model.values, own.model.values)


def test_a_lone_settled_period_is_compared_and_diagnosed_without_a_law():
    loop = period("bouc-wen", "cosine", 0.003, settled=True)
    options = DiagnosisOptions(jobs=1, laws=("bouc-wen",))
    found = compare(Dataset((loop,)), options.laws, options=options)
    assert SAID in found.notes
    assert "closes no loop" not in found.words
    diagnosed = diagnose(Dataset((loop,)), options=options)
    assert SAID in diagnosed.laws.notes
    assert diagnosed.model.preparation.settle > 0
    assert diagnosed.after.held_out.rmse < 2.0 * diagnosed.noise.floor


def test_passes_begin_where_a_device_is_at_rest():
    loop = period("dahl", "cosine", 0.0, settled=True)
    ready = passed(loop, 2)
    assert ready.time.size == 3 * loop.time.size
    assert ready.input[0] == 0.0
    assert np.all(np.diff(ready.input[: loop.time.size]) <= 0.0)
    assert np.array_equal(ready.input[loop.time.size :], np.tile(loop.input, 2))
    assert np.array_equal(ready.measured, loop.output)
    shifted = replace(loop, input=loop.input + 3.0 * np.ptp(loop.input))
    assert passed(shifted, 2).input[0] == shifted.input[0]
    assert passed(shifted, 2, 3.0 * np.ptp(loop.input)).input[0] == 3.0 * np.ptp(loop.input)


def test_a_loop_about_no_input_settles_in_the_middle():
    """Cells that are pinned harder than the loop reaches would stay at the tip where it begins."""
    model = registry.build("models", "energy-based")
    values = {"a": 1.0, "coupling": 0.9, "pinning": 1.0, "spread": 1.0, "reversible": 0.5, "slope": 0.0, "M_s": 1.0}
    column = np.array([[values[q.name]] for q in model.parameters])
    u = DRIVES["cosine"](PHASE)
    loop = Record(PHASE, u, np.zeros(u.size))
    settled, tip = (System(model).respond(ready, column)[-u.size :, 0] for ready in (passed(loop, 8), loop.settled(8)))
    assert abs(settled.max() + settled.min()) < 0.01 * np.ptp(settled)
    assert abs(tip.max() + tip.min()) > 0.1 * np.ptp(tip)

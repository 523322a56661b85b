"""Data that cannot be diagnosed, or hardly: a clear verdict or message, never a confident wrong name."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import compare
from hysteresis_bench import diagnose as diagnose_data
from hysteresis_bench import fit as fit_records
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record
from tests.diagnosis.generator import make

pytestmark = pytest.mark.usefixtures("few_laws")

BARE = Question("bouc-wen", options=DiagnosisOptions(jobs=1))
DYNAMICS = ("creep", "input-lag", "output-lag", "resonance", "second-order-lag", "transport-delay")
FEW = replace(BARE, among=("backlash", "bias", "drift", "rayleigh-hysteresis", "saturation", *DYNAMICS))
"""What is there, and what it may be taken for."""


def first(dataset, **changes):
    record = dataset.records[0]
    return Record(**{"time": record.time, "input": record.input, "output": record.output, "name": "only", **changes})


def part_of(dataset, change=lambda record: record, step=1):
    """Two records to fit and one held out, changed; every n-th sample;  step : n."""
    names = ("fit-1", "fit-2", "held-1")
    records = [change(record).take(slice(None, None, step)) for record in dataset.records if record.name in names]
    return Dataset(tuple(records), names[2:])


def claims(found):
    """Each adopted effect with those that would do as well."""
    return [{name, *(one.rival for one in found.ties if one.effect == name)} for name in found.effects]


@pytest.mark.parametrize("ask", [fit_records, diagnose_data, compare])
def test_an_input_that_never_moves_is_refused(ask):
    moving = first(make(3, "bouc-wen", hidden=()).dataset)
    still = replace(moving, input=np.ones_like(moving.input))
    with pytest.raises(UserError, match="record only: the input is constant; there is nothing to"):
        ask(Dataset((still,)), *(() if ask is compare else ["bouc-wen"]))


def test_one_record_is_split_in_time():
    dataset = Dataset((first(make(3, "bouc-wen", hidden=(), noise=0.004).dataset),))
    found = diagnose(dataset, BARE)
    assert found.verdict == "no-effect-needed"
    assert found.effects == ()
    assert found.split["held_out"] == ["only, last third"]
    assert found.after.held_out == found.before.held_out


def test_no_noise_at_all_and_nothing_hidden():
    case = make(4, "bouc-wen", hidden=(), noise=0.0)
    found = diagnose(case.dataset, BARE)
    assert found.effects == ()
    assert found.verdict == "no-effect-needed"
    assert any("next to no noise" in warning for warning in found.warnings)


@pytest.mark.parametrize("hidden", ["backlash", "input-lag"])
def test_no_noise_at_all_and_one_effect(hidden):
    found = diagnose(part_of(make(4, "bouc-wen", hidden=(hidden,), noise=0.0).dataset), FEW)
    assert len(found.effects) == 1
    assert hidden in claims(found)[0]
    assert found.after.held_out.rmse < 0.1 * found.before.held_out.rmse


def test_noise_is_not_called_none():
    """What lies between the samples adds little to it."""
    record = first(make(3, "bouc-wen", hidden=(), noise=0.004).dataset)
    found = diagnose(Dataset((record.take(slice(0, 160)),)), BARE)
    assert found.noise.floor == pytest.approx(0.004 * np.ptp(record.output), rel=0.2)
    assert not any("next to no noise" in warning for warning in found.warnings)


@pytest.mark.long
def test_an_output_that_is_cut_off():
    """A clip, with the noise of what measures it on top."""
    rng = np.random.default_rng(9)

    def cut(record):
        output = np.clip(record.output, -1.5, 1.5) + 0.012 * rng.standard_normal(record.time.size)
        return replace(record, output=output)

    found = diagnose(part_of(make(3, "bouc-wen", hidden=(), noise=0.0).dataset, cut), BARE)
    assert (found.effects, found.verdict) == (("saturation",), "effect-found")
    assert found.after.held_out.rmse < 1.06 * found.noise.rms
    assert not any("lies at the edge" in warning for warning in found.warnings)


def test_a_delay_longer_than_any_that_is_tried(names_only):
    """The box ends at half a period of the slowest record: whatever is named there is doubted."""

    def late(record):
        return replace(record, output=np.interp(record.time - 0.7, record.time, record.output))

    with names_only():
        found = diagnose(part_of(make(3, "bouc-wen", hidden=(), noise=0.004).dataset, late, 4), FEW)
    assert found.verdict == "unexplained-residual"
    assert not found.effects or "may lack" in found.headline


def test_one_frequency_cannot_show_a_resonance():
    record = first(make(3, "bouc-wen", hidden=("resonance",), noise=0.004).dataset)
    found = diagnose(Dataset((record,)), BARE)
    row = next(row for row in found.candidates if row.effect == "resonance")
    assert not row.applicable
    assert "at the one frequency" in row.reason
    assert all(
        len(names) > 1 and names <= {"input-lag", "output-lag", "transport-delay", "creep"} for names in claims(found)
    )


@pytest.mark.long
def test_an_output_that_runs_backwards_in_time(names_only):
    def backwards(record):
        return replace(record, output=record.output[::-1].copy())

    with names_only():
        found = diagnose(part_of(make(3, "bouc-wen", hidden=(), noise=0.004).dataset, backwards, 2), FEW)
    assert found.verdict == "unexplained-residual"
    assert not found.effects or "may lack" in found.headline
    assert any(
        "does not follow these data" in warning or "does not follow the input" in warning for warning in found.warnings
    )


def test_constant_output():
    dataset = Dataset((first(make(3, "bouc-wen", hidden=()).dataset, output=np.full(400, 2.0)),))
    with pytest.raises(UserError, match="constant"):
        diagnose(dataset, BARE)


def test_output_that_has_nothing_to_do_with_the_input():
    rng = np.random.default_rng(8)
    time = np.linspace(0.0, 5.0, 400)
    walk = np.cumsum(rng.standard_normal(400))
    dataset = Dataset((first(make(3, "bouc-wen", hidden=()).dataset, time=time, output=walk),))
    found = diagnose(dataset, BARE)
    assert found.effects == ()
    assert found.verdict == "unexplained-residual"
    assert "does not follow the input" in found.headline


def test_constant_temperature_is_no_candidate():
    record = first(make(3, "bouc-wen", hidden=()).dataset, columns={"temperature": np.full(400, 21.0)})
    found = diagnose(Dataset((record,)), BARE)
    row = next(row for row in found.candidates if row.effect == "temperature-sensitivity")
    assert not row.applicable
    assert "never changes" in row.reason


def test_one_period_only():
    record = first(make(3, "bouc-wen", hidden=()).dataset)
    found = diagnose(Dataset((record.take(slice(0, 80)),)), BARE)
    assert found.effects == ()
    assert any("One record only" in warning for warning in found.warnings)


def test_unknown_model_and_too_few_samples_are_told_together():
    record = first(make(3, "bouc-wen", hidden=()).dataset)
    with pytest.raises(UserError, match="2 faults"):
        diagnose(Dataset((record.take(slice(0, 12)),)), Question("bouc-when"))


def test_bounds_and_values_of_parameters_that_are_not_there_are_told():
    """Also beside those of effects that the search may add, which are known."""
    time = np.linspace(0.0, 1.0, 200)
    record = Record(time, np.sin(19.0 * time), np.cos(19.0 * time))
    asked = Question(
        "bouc-wen",
        bounds={"alpah": (0.0, 1.0), "input-lag.time_constant": (0.2, 0.1)},
        fixed={"creep.shares": 0.1, "beta": np.nan},
    )
    with pytest.raises(UserError) as told:
        diagnose(Dataset((record,)), asked)
    for said in ('no parameter "alpah"', "is above high", 'no parameter "creep.shares"', "must be finite"):
        assert said in str(told.value)

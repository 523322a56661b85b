"""The advised experiment on a rig: what is played, what is refused, and what became of the ties."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.diagnosis.experiments.settled import Measured, Tied
from hysteresis_bench.diagnosis.findings.advice import Advice
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.diagnosis_study.advised import Bench, driven_rig, measured, nothing_to_measure, ties_after
from hysteresis_bench.diagnosis_study.case import outcome
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record

TIME = np.arange(400) * 1e-3
DRIVE = Record(TIME, 2.0 * np.sin(2 * np.pi * 5.0 * TIME), None, units={"time": "s", "input": "V", "output": "um"})
BENCH = Bench(driven_rig("pea"), "pea", (0, "pea"))


@dataclass(frozen=True)
class Found:
    """A diagnosis as far as an experiment needs it."""

    ties: tuple[Tie, ...] = ()
    effects: tuple[str, ...] = ("input-lag",)
    advice: Advice | None = None
    headline: str = "It lacks a lag."
    measured: Measured | None = None


def found(*pairs, effects=("input-lag",), drive=DRIVE, told=None):
    """pairs : of tied effects"""
    advice = Advice("a sine of 5 Hz", 0.2, 0.02, "Measure it.", told or {}, drive)
    return Found(tuple(Tie(*pair, "they are alike", 0.0) for pair in pairs), effects, advice)


def dataset(**units):
    output = np.sin(2 * np.pi * TIME)
    records = [Record(TIME, output, output, name, {**DRIVE.units, **units}) for name in ("a", "b")]
    return Dataset(tuple(records), ("b",))


@pytest.mark.parametrize("name", ["pea", "gma", "gma-domains", "hidden-effects"])
def test_a_rig_plays_its_own_experiment_as_it_measures_it(name):
    """From rest, with the units that it tells; but for the noise, and for what lies between the samples."""
    first = {"pea": "ramp", "hidden-effects": "slow"}.get(name, "sine-10hz")
    known = measure(name, first).records[0]
    (played,) = driven_rig(name).play(replace(known, output=None, name="again"), np.random.default_rng(1)).records
    assert (played.name, dict(played.units)) == ("again", dict(known.units))
    assert np.interp(known.time, played.time, played.input) == pytest.approx(
        known.input, abs=1e-3 * np.ptp(known.input)
    )
    apart = np.interp(known.time, played.time, played.measured) - known.measured
    assert np.sqrt(np.mean(apart**2)) < 0.02 * np.ptp(known.measured)
    assert {"time", "input", "output"} <= set(driven_rig(name).units)


def test_what_the_voltage_limit_cuts_is_in_the_record_and_told():
    (cut,) = BENCH.rig.play(replace(DRIVE, input=4.0 * DRIVE.input), np.random.default_rng(0)).records
    assert (cut.input.min(), cut.input.max()) == (-5.0, 5.0)
    far = found(("input-lag", "creep"), drive=replace(DRIVE, input=4.0 * DRIVE.input))
    told = measured(dataset(), far, BENCH, lambda more: found()).measured
    assert "from -8 to 8: it went from -5 to 5" in told.notes[0]
    near = measured(dataset(), found(("input-lag", "creep")), BENCH, lambda more: found()).measured
    assert near.notes == ()


def test_the_record_is_fitted_beside_the_others_and_what_is_held_out_stays_so():
    asked = []

    def again(more):
        asked.append(more)
        return found(effects=("creep",))

    known = dataset(time="ms", input="mV", output="1")
    before = found(
        ("input-lag", "creep"), drive=replace(DRIVE, time=1e3 * TIME, input=1e3 * DRIVE.input), told={"creep": 0.9}
    )
    after = measured(known, before, BENCH, again)
    (more,) = asked
    assert [record.name for record in more.fitted] == ["a", "advised-pea"]
    assert [record.name for record in more.held_out] == ["b"]
    new = more.fitted[-1]
    assert dict(new.units) == {"time": "ms", "input": "mV", "output": "1"}
    assert np.ptp(new.input) == pytest.approx(4000.0, rel=1e-3)
    assert np.ptp(new.measured) == pytest.approx(4.0, rel=0.3)  # um, as the records state no unit
    assert after.measured.ties == (Tied(("input-lag", "creep"), 0.9, (("creep",),)),)
    assert "Tied before were input-lag or creep: it is creep." in after.measured.words
    assert BENCH.record_name(more) == "advised-pea-2"
    lone = replace(known, records=known.records[:1], held_out_names=())
    measured(lone, before, BENCH, again)
    assert [record.name for record in asked[-1].fitted] == ["a", "advised-pea"]
    assert asked[-1].held_out_names == ("a, last third",)


def test_records_that_the_rig_cannot_play_are_refused():
    BENCH.check(dataset(input="mV"))
    with pytest.raises(UserError, match="input is in A in the records and in V on the rig pea"):
        BENCH.check(dataset(input="A"))
    with pytest.raises(UserError, match="have no time"):
        BENCH.check(dataset(time="sample"))
    with pytest.raises(ValueError, match=r"rig sma-known-truth cannot play .* These can: .*pea"):
        driven_rig("sma-known-truth")


def test_there_must_be_something_to_settle():
    assert "no tie" in nothing_to_measure(found())
    assert "No experiment" in nothing_to_measure(found(("input-lag", "creep"), drive=None))
    assert "column" in nothing_to_measure(replace(found(("input-lag", "creep")), advice=None))
    assert nothing_to_measure(found(("input-lag", "creep"))) == ""


def test_what_became_of_ties():
    before = found(("input-lag", "creep"), ("input-lag", "resonance"), ("drift", "fatigue"), told={"creep": 0.9})
    for effects, pairs, words, fate in (
        (("creep",), (), "it is creep", "right"),
        (("resonance",), (), "it is resonance", "wrong"),
        (("input-lag",), (("input-lag", "creep"),), "it is input-lag or creep", "narrowed"),
        (
            ("creep",),
            (("creep", "input-lag"), ("creep", "resonance")),
            "the records with it cannot tell either",
            "open",
        ),
        (("creep", "resonance"), (), "claimed are creep and resonance", "wrong"),
        ((), (), "none of them is claimed any more", "gone"),
    ):
        lags, others = ties_after(before, found(*pairs, effects=effects))
        assert (lags.words, outcome(lags, ["creep"])) == (words, fate)
        assert lags.probability is None  # nothing was told of the resonance
        assert outcome(others, ["creep"]) == "void"
    (told, _) = ties_after(
        replace(before, advice=replace(before.advice, probabilities={"creep": 0.9, "resonance": 0.7})), before
    )
    assert told.probability == 0.7


def test_a_thermostat_follows_what_is_slow_and_the_record_has_what_it_reached():
    rig = driven_rig("sma")
    time = np.arange(0.0, 120.0, 0.1)
    for period, reached in ((120.0, True), (10.0, False)):
        wanted = 25.0 - 20.0 * np.cos(2.0 * np.pi * time / period)
        (record,) = rig.play(Record(time, wanted, None, "sine"), np.random.default_rng(0)).records
        missed = np.sqrt(np.mean((record.input - wanted) ** 2))
        assert (missed < 0.03 * 40.0) == reached
        assert record.columns["voltage"].max() <= 5.0

"""Jumps of an output that stay are found without a model, told, and what comes after is fitted with its own offset."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import fit, measure
from hysteresis_bench.data.faults.jumps import SIDE, jumps, jumps_in_words, parted_at_jumps
from hysteresis_bench.data.faults.parts import FEWEST_SAMPLES
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.diagnosis_study.imperfections import IMPERFECTIONS
from hysteresis_bench.fit.checks.faulty_records import without_faults
from hysteresis_bench.inspection.oddities import oddities
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 4.0, 401)
DRIVE = np.sin(2.0 * np.pi * TIME)
OUTPUT = 2.0 * np.tanh(np.sin(2.0 * np.pi * TIME - 0.4)) + 0.01 * np.random.default_rng(1).normal(size=TIME.size)
AT = 210  # neither near a reversal of the input nor where it sets out


def slipped(*steps: tuple[int, float], **changes) -> Record:
    """The record with jumps before samples, by heights."""
    level = sum(height * (np.arange(TIME.size) >= at) for at, height in steps)
    return replace(Record(TIME, DRIVE, OUTPUT + level, "loop"), **changes)


@pytest.mark.parametrize("height", [-1.0, 0.4])
def test_a_jump_is_found_where_it_is_and_told_with_its_height(height):
    record = slipped((AT, height))
    assert jumps(record).tolist() == [AT]
    words = jumps_in_words(record)
    assert "before time 2.1" in words
    told = float(words.split("jumps by ")[1].split(" ")[0])
    assert told == pytest.approx(height, abs=0.1)
    assert any("slipped" in said for said in oddities([record]))


def test_nothing_else_is_taken_for_one():
    assert jumps(slipped()).size == 0
    assert jumps(slipped((AT, 0.01))).size == 0  # within the noise
    assert jumps(slipped(*((60 + 65 * k, 0.8) for k in range(5)))).size == 0  # a device that jumps
    assert jumps(slipped((AT, 0.8), (AT + 60, -0.8))).size == 0  # it comes back: a pulse of the device
    spike = OUTPUT.copy()
    spike[AT] += 1.5
    assert jumps(slipped(output=spike)).size == 0
    leap = DRIVE + 0.5 * (np.arange(TIME.size) >= AT)
    assert jumps(slipped((AT, 0.8), input=leap)).size == 0  # the input does as much
    turn = int(np.argmax(DRIVE[:150]))
    assert jumps(slipped((turn, 0.8))).size == 0  # the device may slip where the input turns
    gap = np.where(np.arange(TIME.size) >= AT, TIME + 0.05, TIME)
    assert jumps(slipped((AT, 0.8), time=gap)).size == 0  # nobody knows what happened in a gap
    assert jumps(slipped(output=None)).size == jumps(slipped(output=np.zeros(TIME.size))).size == 0


def test_what_comes_after_is_a_record_with_all_before_it_as_history():
    data = parted_at_jumps(Dataset((slipped((AT, 0.8)), slipped(name="other")), ("loop",)))
    assert data.names == ("loop", "loop from 2.1", "other")
    assert data.held_out_names == ("loop", "loop from 2.1")
    before, after, _ = data.records
    assert (before.time.size, before.history, after.time.size, after.history) == (AT, 0, TIME.size, AT)
    np.testing.assert_array_equal(before.measured, OUTPUT[:AT])
    np.testing.assert_array_equal(after.measured, OUTPUT[AT:] + 0.8)
    assert np.max(np.abs(np.diff(after.output))) < 0.4  # its history is moved to where it begins: no spike there
    assert jumps(after).size == 0
    assert "as loop from 2.1" in data.notes[0]
    again = parted_at_jumps(data)
    assert (again.names, again.notes) == (data.names, data.notes)


def test_parts_have_names_of_their_own_at_a_clock_of_many_digits():
    record = slipped((AT, 0.8), (AT + 60, 0.8), time=1.7e9 + TIME)
    assert len({*parted_at_jumps(Dataset((record,))).names}) == 3


def test_a_part_too_short_to_be_fitted_is_left_out():
    late, early = TIME.size - FEWEST_SAMPLES // 2, 2 * SIDE + 25
    only = parted_at_jumps(Dataset((slipped((late, 0.8)),))).records
    assert [(one.name, one.time.size) for one in only] == [("loop", late)]
    only = parted_at_jumps(Dataset((slipped((early, 0.8)),))).records
    assert [(one.name, one.history) for one in only] == [("loop", early)]


def test_skipping_scores_no_more_than_was_scored():
    after = parted_at_jumps(Dataset((slipped((AT, 0.8)),))).records[1]
    assert after.skip(0.5).history == AT
    assert after.skip(3.0).history == 300


def test_a_fit_parts_a_record_only_where_each_has_an_offset():
    data = Dataset((slipped((AT, 0.8)),))
    assert without_faults(data, ["bias"]).names == ("loop",)
    plain, own = (fit(data, "bouc-wen", effects) for effects in (["bias"], ["record-offset"]))
    assert any("--effect record-offset" in said for said in plain.warnings)
    assert not any("slipped" in said for said in own.warnings)
    assert any("as loop from 2.1" in note for note in own.notes)
    assert [one for one in own.records["record"]] == ["loop", "loop from 2.1"]
    assert own.records["rmse"].max() < 0.5 * plain.records["rmse"].max()


@pytest.mark.parametrize("seed", range(3))
def test_steps_kinks_relays_and_imperfect_records_are_left_alone(seed):
    rng = np.random.default_rng(seed)
    steps = np.repeat(rng.standard_normal(21), 20)[: TIME.size]
    triangle = np.abs((TIME * rng.uniform(1.0, 3.0)) % 1.0 - 0.5)
    relay = np.sign(np.sin(2.0 * np.pi * TIME * rng.uniform(1.0, 9.0)))
    laplace = np.sin(2.0 * np.pi * TIME) + 0.01 * rng.laplace(size=TIME.size)
    for output in (steps, triangle, relay, laplace):
        assert jumps(slipped(output=output + 1e-3 * rng.standard_normal(TIME.size))).size == 0
    for imperfect in IMPERFECTIONS:
        settings = {"imperfect": imperfect, "draw": seed, "hide": seed}
        records = measure("hidden-effects", *HiddenEffects.experiments, settings=settings, seed=seed).records
        assert [one.name for one in records if jumps(one).size] == []

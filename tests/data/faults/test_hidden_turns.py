"""Gaps in which the input turned are found without a model and told; what follows is fitted from the second turn on."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench.data.faults.hidden_turns import hidden_turns, hidden_turns_told, parted_at_hidden_turns
from hysteresis_bench.fit.checks.faulty_records import counted, without_faults
from hysteresis_bench.inspection.oddities import oddities
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 4.0, 801)
DRIVE = np.sin(2.0 * np.pi * TIME)


def lost(*stretches: tuple[int, int], drive=DRIVE) -> Record:
    """Without these samples."""
    kept = np.ones(TIME.size, bool)
    for low, high in stretches:
        kept[low:high] = False
    return Record(TIME[kept], drive[kept], np.tanh(drive[kept]), "loop")


PEAK, FLANK, NEXT = (420, 480), (370, 430), 650
"""Over the third peak, at 450; on the flank before it; the peak that follows after a trough."""


def test_a_peak_in_a_gap_is_found_with_the_second_turn_after_it():
    record = lost(PEAK)
    ((gap, turn),) = hidden_turns(record)
    assert record.time[gap] == TIME[PEAK[0] - 1]
    assert record.time[turn] == TIME[NEXT]
    assert "2.095 to 2.4" in hidden_turns_told(record)
    assert any("turned in a gap" in said for said in oddities([record]))
    assert any("turned in a gap" in said for said in counted([record]))


def test_a_peak_and_a_trough_in_one_gap_are_found():
    assert hidden_turns(lost((430, 570)))


@pytest.mark.parametrize("stretch", [FLANK, (449, 452), (440, 445)], ids=["flank", "at the peak", "short"])
def test_a_gap_without_a_turn_far_from_its_ends_is_none(stretch):
    record = lost(stretch)
    assert hidden_turns(record) == []
    assert hidden_turns_told(record) == ""


@pytest.mark.parametrize("seed", range(20))
def test_noise_of_the_input_is_no_turn(seed):
    """On a flank, and where the input rests."""
    rng = np.random.default_rng(seed)
    resting = np.clip(DRIVE, -0.5, 0.5)
    for drive, stretch in ((DRIVE, FLANK), (resting, (440, 460))):
        assert hidden_turns(lost(stretch, drive=drive + 2e-3 * rng.normal(size=TIME.size))) == []


@pytest.mark.parametrize("seed", range(20))
def test_a_peak_is_found_in_noise_of_the_input(seed):
    noise = 2e-3 * np.random.default_rng(seed).normal(size=TIME.size)
    assert len(hidden_turns(lost((410, 490), drive=DRIVE + noise))) == 1


def test_where_every_turn_is_lost_the_samples_are_few():
    """Eight turns: then there is nothing to go on from."""
    lost_turns = [(turn - 25, turn + 25) for turn in range(50, 800, 100)]
    assert hidden_turns(lost(*lost_turns)) == []


def test_what_lies_between_the_gap_and_the_second_turn_is_not_scored():
    record = lost(PEAK)
    first, second = parted_at_hidden_turns(Dataset((record,))).records
    assert first.time[-1] == TIME[PEAK[0] - 1]
    assert second.name == "loop from 3.25"
    assert np.array_equal(second.time, record.time)
    assert second.time[second.history] == TIME[NEXT]
    (note,) = without_faults(Dataset((record,))).notes
    assert "second turn on as loop from 3.25." in note


def test_parts_of_what_is_held_out_are_held_out():
    other = replace(lost(PEAK), name="other")
    dataset = parted_at_hidden_turns(Dataset((lost(PEAK), other), ("other",)))
    assert dataset.held_out_names == ("other", "other from 3.25")


def test_what_is_not_scored_stays_so():
    """A gap in the history: the record goes on from the second turn, or from where it is scored."""
    for skipped, begins in ((2.6, TIME[NEXT]), (3.5, 3.5)):
        (one,) = parted_at_hidden_turns(Dataset((lost(PEAK).skip(skipped),))).records
        assert one.time[one.history] == pytest.approx(begins)

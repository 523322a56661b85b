"""Where an output is stuck is found without a model, told, and not fitted."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench.data.faults.stuck import parted_where_stuck, stuck, stuck_told
from hysteresis_bench.fit.checks.faulty_records import counted, without_faults
from hysteresis_bench.inspection.oddities import oddities
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 4.0, 401)
DRIVE = np.sin(2.0 * np.pi * TIME)
NOISE = 0.01 * np.random.default_rng(1).normal(size=TIME.size)
CURVE = 2.0 * np.tanh(np.sin(2.0 * np.pi * TIME - 0.4))
AT, UP_TO = 200, 225
"""On a flank, over a reversal."""


def hung(*stretches: tuple[int, int], output=CURVE + NOISE, **changes) -> Record:
    held = output.copy()
    for low, high in stretches:
        held[low:high] = held[low - 1]
    return replace(Record(TIME, DRIVE, held, "loop"), **changes)


@pytest.mark.parametrize("step", [0.0, 0.02])
def test_a_stretch_that_ends_in_a_leap_is_found(step):
    """Also of an output in steps of a two hundredth of its range."""
    output = CURVE + NOISE if step == 0.0 else step * np.rint((CURVE + NOISE) / step)
    ((low, high),) = stuck(hung((AT, UP_TO), output=output))
    assert abs(low - AT) <= 1
    assert high == UP_TO
    assert any("did the channel hang" in said for said in oddities([hung((AT, UP_TO))]))
    assert "2 to 2.24" in stuck_told(hung((AT, UP_TO)))


def test_a_channel_that_dies_is_found_by_the_leap_before():
    output = CURVE + NOISE
    output[300:] = 0.0
    assert stuck(hung(output=output)) == [(301, 401)]


def test_nothing_else_is_taken_for_one():
    assert stuck(hung()) == []
    assert stuck(hung((AT, AT + 4))) == []  # too short to change a fit
    assert stuck(hung(output=np.clip(CURVE, -1.5, 1.5))) == []  # an end stop leaves no leap
    play = np.maximum.accumulate(CURVE[:120])
    assert stuck(hung(output=np.concatenate([play, CURVE[120:] + play[-1] - CURVE[120]]))) == []  # nor does a dead band
    assert stuck(hung(output=0.5 * np.rint(CURVE / 0.5))) == []  # a coarse converter
    assert stuck(hung(*((40 + 70 * k, 60 + 70 * k) for k in range(5)))) == []  # a device that sticks and slips
    assert stuck(hung((AT, UP_TO), input=np.where((TIME > 1.9) & (TIME < 2.3), 0.3, DRIVE))) == []  # the input rests
    leap = hung((AT, UP_TO), input=DRIVE + 5.0 * (np.arange(TIME.size) >= UP_TO))
    assert stuck(leap) == []  # the input leaps as well
    assert stuck(replace(hung(), output=None)) == stuck(replace(hung(), output=np.zeros(TIME.size))) == []


def test_what_is_stuck_is_not_scored_and_what_comes_after_remembers_all_before():
    data = parted_where_stuck(Dataset((hung((AT, UP_TO)), hung(name="other")), ("loop",)))
    assert data.names == ("loop", "loop from 2.25", "other")
    assert data.held_out_names == ("loop", "loop from 2.25")
    before, after, _ = data.records
    assert (before.time.size, before.history, after.time.size, after.history) == (AT, 0, TIME.size, UP_TO)
    np.testing.assert_array_equal(after.measured, (CURVE + NOISE)[UP_TO:])
    assert "as loop from 2.25" in data.notes[0]
    again = parted_where_stuck(data)
    assert (again.names, again.notes) == (data.names, data.notes)


def test_the_leap_at_its_end_is_no_jump_that_stays():
    found = without_faults(Dataset((hung((AT, UP_TO)),)))
    assert found.names == ("loop", "loop from 2.25")
    assert len(found.notes) == 1


def test_a_prediction_tells_what_its_errors_count_and_no_device_did():
    spiked = (CURVE + NOISE).copy()
    spiked[150] += 3.0
    moved = np.where(TIME < 2.5, CURVE + NOISE, CURVE + NOISE + 1.0)
    faulty = [hung((AT, UP_TO)), hung(output=spiked, name="spiked"), hung(output=moved, name="moved")]
    told = counted([*faulty, hung(name="sound"), replace(hung(), output=None, name="input only")])
    assert [sentence.split(":")[0] for sentence in told] == ["record loop", "record spiked", "record moved"]
    assert all(sentence.endswith("The errors count it.") for sentence in told)
    assert not any("bridged" in sentence or "fitted" in sentence for sentence in told), "nothing is mended"

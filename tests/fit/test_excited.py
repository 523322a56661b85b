"""What fitted inputs did is kept with the model: how often and how far they turned."""

import numpy as np
import pytest

from hysteresis_bench.fit.unseen.excited import AMPLITUDE, FREQUENCY, excited, unlike
from hysteresis_bench.signals import Record

TIME = np.arange(4001) / 1000.0


def record(driven, unit="s", history=0):
    return Record(TIME, driven, driven, "one", {"time": unit}, history=history)


def test_half_cycles_are_measured():
    slow, fast = 2.0 * np.sin(2 * np.pi * TIME), 5.0 + np.sin(2 * np.pi * 8.0 * TIME)
    found = excited([record(slow), record(fast)])
    assert found[FREQUENCY] == pytest.approx([1.0, 8.0], rel=0.02)
    assert found[AMPLITUDE] == pytest.approx([1.0, 2.0], rel=0.01)
    chirp = excited([record(np.sin(2 * np.pi * (1.0 + 2.0 * TIME) * TIME))])[FREQUENCY]
    assert chirp == pytest.approx([2.2, 16.7], rel=0.05)


def test_what_is_not_scored_and_an_index_say_nothing_of_frequency():
    late = np.where(TIME < 2.0, np.sin(2 * np.pi * 20.0 * TIME), np.sin(2 * np.pi * TIME))
    assert excited([record(late, history=2000)])[FREQUENCY][1] < 1.1
    assert set(excited([record(late, unit="sample")])) == {AMPLITUDE}


def test_one_way_up_and_down_is_two_half_cycles():
    assert excited([record(2.0 - np.abs(2.0 - TIME))]) == {FREQUENCY: [0.25, 0.25], AMPLITUDE: [1.0, 1.0]}


def test_a_quarter_more_is_alike():
    known = {FREQUENCY: [1.0, 4.0], AMPLITUDE: [1.0, 2.0]}
    assert unlike(known, {FREQUENCY: (0.9, 4.9), AMPLITUDE: (0.9, 2.4)}) == []
    assert unlike(known, {FREQUENCY: (0.7, 5.1), AMPLITUDE: (0.7, 2.6)}) == ["slower", "faster", "smaller", "larger"]
    assert unlike({}, {FREQUENCY: (0.7, 5.1)}) == []

"""Gaps between samples in which the input turned: nobody measured how far it went.

A device with hysteresis remembers where its input turned. Behind such a gap it does what no model can tell, until the
input has turned twice where it was measured: the branch from the first of these turns leads to what nobody measured. So
what lies between is simulated and not scored, and the rest is a record of its own, all before it history.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.faults.parts import parted, parts
from hysteresis_bench.kernels.turning_points import turning_points
from hysteresis_bench.signals import Dataset, Record

LONG = 4.0
"""Of the median step, from which a step is a gap."""

SIDE = 5
"""Samples on either side through which a line tells where the input goes."""

BEYOND = 0.02
"""Of its range, how far the input must have gone beyond what was measured on both sides, by these lines; and what a
turn of it is."""

CLEAR = 4.0
"""Standard errors of that, by how the samples lie off the lines: a measured input has noise. Of 1265 made gaps with
turns 811 are found, and 86 of 1024 without, next to a turn; with half of it 927 and 105, with twice 663 and 57."""

MOST_GAPS = 5
"""Gaps of a record, beyond which its samples are few everywhere."""


def parted_at_hidden_turns(dataset: Dataset) -> Dataset:
    """The data set without what lies between such gaps and the second turn, and a note on each record that has some."""
    return parted(dataset, _apart)


def hidden_turns_told(record: Record) -> str:
    """Where the input of a record turned in a gap, and what is done about it; empty where it did not."""
    found = hidden_turns(record)
    return f"{_words(record, found)} What comes after is fitted from the second turn on." if found else ""


def hidden_turns_in_words(record: Record) -> str:
    """Where the input of a record turned in a gap; empty where it did not."""
    found = hidden_turns(record)
    return _words(record, found) if found else ""


def hidden_turns(record: Record) -> list[tuple[int, int]]:
    """Last sample before each gap in which the input turned, and the one at which it then turns for the second time, or
    the number of samples; empty where there is none."""
    time, u = record.time, record.input
    if time.size < 4 * SIDE or not np.ptp(u) > 0.0:
        return []
    steps = np.diff(time)
    gaps = np.flatnonzero(steps > LONG * float(np.median(steps)))
    gaps = gaps[(gaps >= SIDE - 1) & (gaps < time.size - SIDE)]
    found = [int(gap) for gap in gaps if _turned(time, u, int(gap))]
    if len(found) > MOST_GAPS:
        return []
    return [(gap, _second_turn(u, gap + 1)) for gap in found]


def _turned(time: Array, u: Array, gap: int) -> bool:
    """Do lines through the samples on both sides say that the input went further than both, and came back?"""
    middle = 0.5 * (time[gap] + time[gap + 1])
    (left, before, off_left), (right, after, off_right) = (
        _line(time[side] - middle, u[side]) for side in (slice(gap + 1 - SIDE, gap + 1), slice(gap + 1, gap + 1 + SIDE))
    )
    half = 0.5 * float(time[gap + 1] - time[gap])
    ends = left - before * half, right + after * half
    if before * after < 0.0:
        meet = (right - left) / (before - after)
        beyond = np.sign(before) * (left + before * meet) - max(np.sign(before) * end for end in ends)
    else:
        beyond = -np.sign(before) * (ends[1] - ends[0])
    error = np.hypot(off_left, off_right) * half / (time[gap] - time[gap + 1 - SIDE])
    return bool(beyond > max(BEYOND * float(np.ptp(u)), CLEAR * error))


def _line(away: Array, values: Array) -> tuple[float, float, float]:
    """Its value in the middle of the gap, its slope, and how far the samples lie off it (RMS)."""
    slope, value = np.polyfit(away, values, 1)
    off = values - (value + slope * away)
    return float(value), float(slope), float(np.sqrt(np.sum(off**2) / (away.size - 2)))


def _second_turn(u: Array, first: int) -> int:
    turns = turning_points(np.ascontiguousarray(u[first:]), BEYOND * float(np.ptp(u)))
    return first + int(turns[1]) if turns.size > 1 else u.size


def _apart(record: Record) -> tuple[tuple[Record, ...], str]:
    found = hidden_turns(record)
    if not found or record.output is None:
        return (record,), ""
    begins = [record.history, *(max(turn, record.history) for _, turn in found)]
    ends = [*(gap + 1 for gap, _ in found), record.time.size]
    return (
        parts(record, list(zip(begins, ends, strict=True))),
        f"{_words(record, found)} What comes after is fitted from the second turn on",
    )


def _words(record: Record, found: list[tuple[int, int]]) -> str:
    each = ", ".join(f"{record.time[gap]:.6g} to {record.time[gap + 1]:.6g}" for gap, _ in found)
    return (
        f"record {record.name}: the input turned in a gap between its samples ({each}), and nobody measured where. No "
        "model can follow what remembers that."
    )

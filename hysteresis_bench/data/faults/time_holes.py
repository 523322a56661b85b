"""Holes in time: a step that is much longer than the others, where rows are missing that nobody has marked.

Rows without a number are told as gaps where the file is read; where the rows themselves are gone, only the time knows.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import INDEX, Record

LONG = 5.0
"""Of the median step, and of the longest one beside it, from which a step is a hole. Of 760 made records with uneven
steps (jitter of up to 45 % of one; normal, gamma, exponential and log-normal spread; two rates; growing ones; samples
taken where the input had moved by so much) none is said to have a hole, and of 120 of which 5, 20 or 50 % of the
samples are missing at random, 7. Half of it says so of 30 and 112, twice of none. Where steps are even or rounded, 8
missing samples are found, and 20 where they jitter by 45 %, too; half of it finds 3 missing ones, twice no 8."""

BESIDE = 3
"""Steps on either side that a hole is compared with: a logger that turns to a slower rate makes no holes."""

UNEVEN = 4.0
"""Ratio of the ninth to the first decile of the steps beyond which no step can be told to be long."""

FEWEST_STEPS = 10
"""Steps by which the usual one is known."""

ALIKE, MOVED = 2.0, 1.5
"""Ratio of the ninth to the first decile of a channel's movements up to which samples may have been taken when it had
moved by so much, and of the ninth decile, beyond which it has moved by more: such a record has no sample where the
channel rests, and lacks none."""

SHOWN = 4
"""Holes that a sentence lists."""


def time_holes(record: Record) -> Array:
    """The last sample before each hole, rising indices; empty where there is none, or where the steps are uneven."""
    steps = np.diff(record.time)
    if steps.size < FEWEST_STEPS:
        return np.empty(0, dtype=int)
    low, middle, high = np.quantile(steps, (0.1, 0.5, 0.9))
    if high > UNEVEN * low:
        return np.empty(0, dtype=int)
    ends = np.full(BESIDE, middle)
    around = sliding_window_view(np.concatenate((ends, steps, ends)), 2 * BESIDE + 1).copy()
    around[:, BESIDE] = middle  # in place of the step itself
    found = np.flatnonzero(steps > LONG * np.max(around, axis=1))
    for channel in (record.input, record.output):
        if channel is not None and found.size:
            moves = np.abs(np.diff(channel))
            least, most = np.quantile(moves, (0.1, 0.9))
            if most <= ALIKE * least:
                found = found[moves[found] > MOVED * most]
    return np.asarray(found, dtype=int)


def time_holes_told(record: Record, holes: Array, lines: Array) -> str:
    """The sentence on these holes; empty without any.

    holes : last sample before each;  lines : (samples,) where the samples stand in the file
    """
    if not holes.size:
        return ""
    stated = record.units.get("time", "s")
    unit = " samples" if stated == INDEX else f" {stated}" if stated not in ("", "1") else ""
    each = [
        f"{float(record.time[hole + 1] - record.time[hole]):.4g}{unit} between rows {lines[hole]} and {lines[hole + 1]}"
        for hole in holes[:SHOWN].tolist()
    ]
    more = f" and {holes.size - SHOWN} more" if holes.size > SHOWN else ""
    usual = float(np.median(np.diff(record.time)))
    one = holes.size == 1
    return (
        f"{'a hole' if one else f'{holes.size} holes'} in the time of record {record.name}: no sample for "
        f"{', '.join(each)}{more}, where the others are {usual:.4g}{unit} apart; across "
        f"{'it' if one else 'them'} the input is taken to have gone straight on."
    )

"""Outputs that are stuck: one value again and again, as where a channel hangs, samples are lost, or a cable fell off.

They are found without a model: the output repeats one value to the last bit while the input moves, and leaves it by a
leap, much larger than noise and than the output moves around it; or it came to it by such a leap and stays to the end.
A device that is held, by friction or by a stop, or an output of coarse steps, does not leap so; one that sticks and
slips does, again and again, and is left alone. What comes after is a record of its own, all before it history.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.faults.parts import parted, parts
from hysteresis_bench.data.faults.spikes import FAR, distances, usual_distance
from hysteresis_bench.signals import Dataset, Record

REPEATED = 5
"""Times that a value is repeated at least: fewer change no fit."""

MOVED = 0.02
"""Of its range, by how much the input moves meanwhile: at rest any output may hold still."""

AROUND = 8
"""Movements of the output on either side that are looked at."""

MOTION = 3.0
"""Of the largest of these, what a leap is. Of 118 made freezes worth three times the noise 109 are found, with half of
it 112, with twice it 102; none where there is none, in 435 records either way."""

SMALLEST = 0.01
"""Of the output's range, what is left alone in any case."""

MOST_STRETCHES, MOST_OF_A_RECORD = 3, 0.3
"""Stretches of a record, and their share of it, beyond which it is the device."""


def parted_where_stuck(dataset: Dataset) -> Dataset:
    """The data set without what a stuck output says, and a note on each record that has some."""
    return parted(dataset, _apart)


def stuck_told(record: Record) -> str:
    """Where the output of a record is stuck, and what is done about it; empty where it is not."""
    words = stuck_in_words(record)
    return words and f"{words} It is not fitted there; what comes after is a record of its own."


def stuck_in_words(record: Record) -> str:
    """Where the output of a record is stuck; empty where it is not."""
    found = stuck(record)
    return _words(record, found) if found else ""


def stuck(record: Record) -> list[tuple[int, int]]:
    """First repeated sample of each stretch of the scored output, and the one behind; empty where there is none."""
    if record.output is None or record.measured.size < 4 * AROUND or not np.ptp(record.measured) > 0.0:
        return []
    u, y = record.input[record.scored], record.measured
    still = np.concatenate(([False], np.diff(y) == 0.0, [False])).astype(int)
    edges = np.flatnonzero(np.diff(still)) + 1
    runs = [(int(low), int(high)) for low, high in zip(edges[::2], edges[1::2], strict=True) if high - low >= REPEATED]
    usual = usual_distance(y, *distances(record.time[record.scored], y))
    least = max(FAR * usual, SMALLEST * np.ptp(y))
    found = [
        (low, high)
        for low, high in runs
        if np.ptp(u[low - 1 : high]) > MOVED * np.ptp(u)
        and (_leaps(y, u, high, least) if high < y.size else _leaps(y, u, low - 1, least))
    ]
    few = len(found) <= MOST_STRETCHES and sum(high - low for low, high in found) <= MOST_OF_A_RECORD * y.size
    return [(low + record.history, high + record.history) for low, high in found] if few else []


def _leaps(y: Array, u: Array, sample: int, least: float) -> bool:
    """Does the output leap at this sample, and the input not?"""
    if sample == 0:
        return False
    moves = np.abs(np.diff(y[max(sample - 1 - AROUND, 0) : sample + 1 + AROUND]))
    at = min(sample - 1, AROUND)
    leap = moves[at]
    driven = np.abs(np.diff(u[max(sample - 1 - AROUND, 0) : sample + 1 + AROUND]))
    calm = driven[at] <= MOTION * float(np.max(np.delete(driven, at), initial=0.0))
    return bool(leap > max(least, MOTION * float(np.max(np.delete(moves, at), initial=0.0))) and calm)


def _apart(record: Record) -> tuple[tuple[Record, ...], str]:
    found = stuck(record)
    if not found:
        return (record,), ""
    borders = [record.history, *(edge for stretch in found for edge in stretch), record.time.size]
    between = [*pairwise(borders)][::2]
    return parts(record, between), f"{_words(record, found)} It is not fitted there, and what comes after is fitted"


def _words(record: Record, found: list[tuple[int, int]]) -> str:
    each = [f"{record.time[low]:.6g} to {record.time[high - 1]:.6g}" for low, high in found]
    return (
        f"record {record.name}: the output holds one value while the input moves, and leaps ({', '.join(each)}): did "
        "the channel hang?"
    )

"""Dropouts: samples that a channel lost, and a file tells as one value again and again, such as 0 or -999.

They are found without a model: short runs of one value, to the last bit, that the column leaps to and back from, by
much more than it moves around them, several of them with the same value, while the other column goes on, or leaps to
that value too. A device that rests or is stopped does not leap to where it stays, and one that is driven by pulses
answers to them. These rows are left out: between those beside them the input is taken to have gone straight on.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.faults.spikes import AROUND, FAR, MOTION, distances, usual_distance
from hysteresis_bench.signals import Dataset, Record

LONGEST = 12
"""Samples of a run at most: over more, nobody knows what the input did."""

FEWEST = 3
"""Runs of one value at least. In 20 measured devices none is found with two, and in two of them a lone run with one;
with half of `MOTION`, twice `APART` or twice `LONGEST` none is found either."""

APART = 0.5
"""Of the smaller leap, by how much the column may have moved on meanwhile."""

MOSTLY = 0.3
"""Of all samples of that value, the share that leaps from which all of them were lost. Half of it changes nothing in
four made records with 26 to 30 such samples, with twice of it half of them stay in two."""

MOST_OF_A_RECORD = 0.2
"""Share of a record's samples beyond which it is the device."""


LEFT_OUT = "These rows are left out."


def without_dropouts(dataset: Dataset) -> Dataset:
    """The data set without the rows that were lost, and a note on every record that has some."""
    records, notes = [], list(dataset.notes)
    for record in dataset.records:
        if lost := _lost(record):
            notes.append(f"{_words(record, lost)} {LEFT_OUT}")
            record = record.take(~np.any([*lost.values()], axis=0))
        records.append(record)
    return replace(dataset, records=tuple(records), notes=tuple(notes))


def dropouts_told(record: Record) -> str:
    """Where the dropouts of a record are and what a fit does with them; empty without any."""
    words = dropouts_in_words(record)
    return words and f"{words} {LEFT_OUT}"


def dropouts_in_words(record: Record) -> str:
    """Where the dropouts of a record are; empty without any."""
    lost = _lost(record)
    return _words(record, lost) if lost else ""


def dropouts(record: Record) -> Array:
    """Which rows of the whole record were lost, (samples,) of bool."""
    lost: Array = np.any([np.zeros(record.time.size, dtype=bool), *_lost(record).values()], axis=0)
    return lost


def _lost(record: Record) -> dict[str, Array]:
    """Which samples were, (samples,) of bool, of the input and of the output, by name; without those that lost none."""
    columns = {"input": record.input, "output": record.output}
    known = {name: c for name, c in columns.items() if c is not None and c.size >= 8 * AROUND and np.ptp(c) > 0.0}
    lost = {
        name: _lost_of(record.time, c, [one for one in known.values() if one is not c]) for name, c in known.items()
    }
    lost = {name: rows for name, rows in lost.items() if np.any(rows)}
    return lost if lost and np.mean(np.any([*lost.values()], axis=0)) <= MOST_OF_A_RECORD else {}


def _lost_of(time: Array, values: Array, columns: list[Array]) -> Array:
    """Which samples of a column were, (samples,) of bool, but for a run at either end;  columns : all of the record"""
    ends = np.flatnonzero(np.diff(values) != 0.0)
    lows, highs = ends[:-1] + 1, ends[1:] + 1
    _, which, count = np.unique(values[lows], return_inverse=True, return_counts=True)
    often = (count[which] >= FEWEST) & (highs - lows <= LONGEST)
    least = FAR * usual_distance(values, *distances(time, values))
    alike = defaultdict[float, list[tuple[int, int]]](list)
    for low, high in zip(lows[often].tolist(), highs[often].tolist(), strict=True):
        value = float(values[low])
        gone_on = (_calm(one, low, high) or np.all(one[low:high] == value) for one in columns)
        if _leaps(values, low, high, least) and all(gone_on):
            alike[value].append((low, high))
    lost = np.zeros(values.size, dtype=bool)
    for value, found in alike.items():
        same = values == value
        same[: ends[0] + 1] = same[ends[-1] + 1 :] = False
        leaping = np.zeros_like(same)
        for low, high in found:
            leaping[low:high] = True
        if len(found) >= FEWEST:  # of a value that is seldom anything else, the others were lost while it passed by
            lost |= same if np.mean(leaping[same]) > MOSTLY else leaping
    return lost


def _leaps(values: Array, low: int, high: int, least: float) -> bool:
    """Does the column leap to the value of this run and back, by much more than it moves around it?"""
    leaps = values[low] - values[low - 1], values[low] - values[high]
    size = min(map(abs, leaps))
    if leaps[0] * leaps[1] <= 0.0 or size <= least or abs(values[high] - values[low - 1]) > APART * size:
        return False
    return bool(size > MOTION * _around(values, low, high))


def _calm(values: Array, low: int, high: int) -> bool:
    """Does another column go on there as it does around it? One that is driven leaps with what drives it."""
    leap = max(abs(values[low] - values[low - 1]), abs(values[high] - values[high - 1]))
    return bool(leap <= MOTION * _around(values, low, high))


def _around(values: Array, low: int, high: int) -> float:
    """The largest movement from sample to sample on either side of a run."""
    before, after = values[max(low - 1 - AROUND, 0) : low], values[high : high + AROUND + 1]
    return float(np.max(np.abs(np.concatenate([np.diff(before), np.diff(after)])), initial=0.0))


def _words(record: Record, lost: dict[str, Array]) -> str:
    told = []
    for name, rows in lost.items():
        column = record.input if name == "input" or record.output is None else record.output
        values = " or ".join(f"{value:.6g}" for value in np.unique(column[rows]).tolist())
        told.append(f"the {name} leaps to {values} and back ({np.count_nonzero(rows)} samples)")
    return f"record {record.name}: {', '.join(told)}: were they lost?"

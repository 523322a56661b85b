"""Jumps: a level that changes from one sample to the next and stays, as where a sensor slips or is zeroed anew.

One of them looks like a drift, and decides a fit. They are found without a model: between two samples the output jumps
where straight lines through the samples on either side miss each other by much more than they usually do and than the
output moves around it, where nothing is left of that once the rest is moved back, and where the input does nothing of
the kind. What comes after a jump is a record of its own then, all before it simulated and not scored: so it has an
offset of its own, and the model its memory. Where the device itself jumps, that costs one offset.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.faults.parts import parted, parts
from hysteresis_bench.data.faults.spikes import FAR
from hysteresis_bench.data.faults.stuck import stuck
from hysteresis_bench.kernels.white_noise import MEDIAN
from hysteresis_bench.signals import Dataset, Record

SIDE = 4
"""Samples on either side through which the lines go. With twice as many a sharp reversal is off its lines."""

MOTION = 1.5
"""Of the largest movement from sample to sample around it. Of 600 made jumps of a tenth and a fifth of the range 450
are found, with half of it 453, with twice it 404; most of the others lie where the input turns."""

SMALLEST = 0.03
"""Of the output's range, what is left alone in any case: devices jump so far themselves. With half of it a friction
damper that sticks is taken for a slip, with a third the yield drop of a steel coupon; twice it misses real ones."""

LEFT = 0.25
"""Of a jump, by how much lines beside it may still miss each other once it is moved back: beside a steep flank they do
by more."""

ALIKE = 0.1
"""Of the output's jump, each of its own range, by how much the input may jump there, which then does of the kind."""

TURNS = 0.9
"""Of the faster of the input's movements on either side, their difference from which it turns or sets out there."""

GAP = 1.5
"""Of the steps beside it, from which a step is a gap: nobody knows what happened there."""

MOST_JUMPS = 3
"""A record with more of them has a device that jumps. Of jumps that undo each other it is the device as well."""


def parted_at_jumps(dataset: Dataset) -> Dataset:
    """The data set with every record parted where its output jumps, and a note on each.

    Before spikes are looked for: the step would be taken for half of one.
    """
    return parted(dataset, _apart)


def jumps_in_words(record: Record) -> str:
    """Where and by how much the output of a record jumps; empty without any."""
    found = jumps(record)
    return _words(record, found) if found.size else ""


def jumps(record: Record) -> Array:
    """Samples before which the scored output jumps, rising indices; empty where there is no output or it does not."""
    nothing = np.empty(0, int)
    if record.output is None or record.measured.size < 4 * SIDE or not np.ptp(record.measured) > 0.0:
        return nothing
    time, u, y = record.time[record.scored], record.input[record.scored], record.measured
    misses, _ = _lines(time, y)
    usual = float(np.median(np.abs(misses))) / MEDIAN
    least = max(FAR * usual, SMALLEST * float(np.ptp(y)))
    leaps, (left, right) = _lines(time, u)
    driven = np.abs(leaps) * float(np.ptp(y)) > ALIKE * np.abs(misses) * float(np.ptp(u))
    turns = np.abs(right - left) > TURNS * np.maximum(np.abs(left), np.abs(right))
    far = np.flatnonzero((np.abs(misses) > least) & ~driven & ~turns)
    found = np.array([gap for gap in far.tolist() if _lone(time, y, gap, float(misses[gap]))], int)
    for low, high in stuck(record):  # the leap at its end is no level that stays
        found = found[np.abs(found + SIDE + record.history - 0.5 * (low + high)) > 0.5 * (high - low) + SIDE]
    by = misses[found]
    if not 0 < found.size <= MOST_JUMPS or abs(float(np.sum(by))) <= 0.5 * float(np.max(np.abs(by))):
        return nothing
    return found + SIDE + record.history


def _lines(time: Array, values: Array) -> tuple[Array, tuple[Array, Array]]:
    """Right of every gap between two samples minus left of it, in its middle, by lines through SIDE samples each:
    (samples - 2 SIDE + 1,), unit of the values, the first before the sample SIDE; and their slopes, left and right."""
    count = values.size - 2 * SIDE + 1
    window = np.arange(count)[:, None] + np.arange(2 * SIDE)
    middle = 0.5 * (time[SIDE - 1 : SIDE - 1 + count] + time[SIDE : SIDE + count])
    ends, slopes = [], []
    for side in (window[:, :SIDE], window[:, SIDE:]):
        away = time[side] - middle[:, None]
        mean = away.mean(axis=1, keepdims=True)
        slopes.append(np.sum((away - mean) * values[side], axis=1) / np.sum((away - mean) ** 2, axis=1))
        ends.append(values[side].mean(axis=1) - slopes[-1] * mean[:, 0])
    return ends[1] - ends[0], (slopes[0], slopes[1])


def _lone(time: Array, y: Array, gap: int, height: float) -> bool:
    """Is it the jump alone: more than any movement around it, and nothing left once the rest is moved back?"""
    low, high = max(gap - SIDE, 0), min(gap + 3 * SIDE, y.size)
    at, steps = gap + SIDE - low, np.diff(time[low:high])
    if steps[at - 1] > GAP * float(np.median(steps)):
        return False
    moved = y[low:high].copy()
    moved[at:] -= height
    if abs(height) <= MOTION * float(np.max(np.abs(np.diff(moved)))):
        return False
    return bool(np.max(np.abs(_lines(time[low:high], moved)[0])) < LEFT * abs(height))


def _apart(record: Record) -> tuple[tuple[Record, ...], str]:
    """All before a part is moved to where the part begins."""
    found = jumps(record)
    if not found.size:
        return (record,), ""
    risen = np.zeros(record.time.size)
    for sample in found.tolist():
        risen[sample:] += _height(record, sample)
    own = parts(record, [*pairwise([record.history, *found.tolist(), record.time.size])])
    moved = tuple(_moved(part, risen) for part in own)
    return moved, f"{_words(record, found)} What comes after is fitted with an offset of its own"


def _moved(part: Record, risen: Array) -> Record:
    """risen : by how much the whole record's output has jumped, (samples,)"""
    assert part.output is not None
    output, low = part.output.copy(), part.history
    output[:low] += risen[low] - risen[:low]
    return replace(part, output=output)


def _words(record: Record, found: Array) -> str:
    each = [f"by {_height(record, k):.3g} before time {record.time[k]:.6g}" for k in found.tolist()]
    return (
        f"record {record.name}: the output jumps {', '.join(each)} and stays there, and the input does nothing of the "
        "kind: a sensor that slipped, or was zeroed anew?"
    )


def _height(record: Record, sample: int) -> float:
    """Of the jump before a sample, unit of the output."""
    around = slice(sample - SIDE, sample + SIDE)
    assert record.output is not None
    return float(_lines(record.time[around], record.output[around])[0][0])

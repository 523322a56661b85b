"""Spikes: lone samples of an output that lie far off their neighbours, as a glitch of a converter leaves them.

A few of them decide a least-squares fit. They are found without a model, bridged, and told one by one: a sample is a
spike where it lies off the cubic through its two neighbours on either side by much more than the record's samples
usually do and than the output moves around it, where its neighbours agree with each other once it is bridged (those
of a step do not), and where the input does nothing of the kind. Two near each other hide each other: they are bridged
together.
"""

from __future__ import annotations

from dataclasses import replace
from math import prod

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.white_noise import MEDIAN
from hysteresis_bench.signals import Dataset, Record

FAR = 10.0
"""Of the usual distance from the cubic (a standard deviation, by the median). Of 1e12 samples of normal noise none is
so far off. Half of it takes noise with heavy tails for spikes; with twice it, spikes of 20 times the noise are
missed."""

MOTION = 3.0
"""Of the largest movement from sample to sample around it: a sharp reversal reaches 0.7, slip in a friction damper
more."""

AGREE = 0.25
"""Of the spike, how far its neighbours may lie off their cubics once it is bridged; beside a step they do by 0.33."""

SMALLEST = 2e-3
"""Of the output's range, what is left alone in any case: it changes no fit."""

MOST = 0.02
"""Share of a record's samples beyond which they are no lone samples; then none is touched."""

AROUND = 3
"""Movements on either side that are looked at; within one more, two spikes hide each other. Two samples next to each
other are no lone ones: a pulse of that width may be the device's own."""

NEAR = 12
"""Samples on either side that what is asked of a pair of spikes reaches at most."""

SEEN_AT = 5
"""Samples that lie far off their cubics because of one spike, at most."""

LOUD = 1.0
"""Mean square of the noise of a bridge over that of the samples, from which a line is one. Of even samples a cubic has
0.94 of it. On 120 made records, two thirds of them uneven, half and twice of it change what is left by less than 1 %;
without it 0.16 samples a record end farther off than five times the noise, with it 0.05."""

LISTED = 8
"""Samples that a sentence names."""


def without_spikes(dataset: Dataset) -> Dataset:
    """The data set with the spikes of its outputs bridged, and a note on every record that had some."""
    records, notes = [], list(dataset.notes)
    for record in dataset.records:
        found = spikes(record)
        if found.size and record.output is not None:
            notes.append(f"{_words(record, found)} {_mended(found)}")
            record = replace(record, output=_bridged(record.time, record.output, found.tolist()))
        records.append(record)
    return replace(dataset, records=tuple(records), notes=tuple(notes))


def spikes_told(record: Record) -> str:
    """Where the spikes of a record are and what a fit does with them; empty without any."""
    found = spikes(record)
    return f"{_words(record, found)} {_mended(found)}" if found.size else ""


def spikes_in_words(record: Record) -> str:
    """Where the spikes of a record are; empty without any."""
    found = spikes(record)
    return _words(record, found) if found.size else ""


def spikes(record: Record) -> Array:
    """Samples of the whole record that are spikes, rising indices; empty where there is no output or none is one."""
    nothing = np.empty(0, int)
    if record.output is None or record.time.size < 4 * AROUND or not np.ptp(record.output) > 0.0:
        return nothing
    y, time = record.output.copy(), record.time
    off, loudness = distances(time, y)
    off[[0, 1, -2, -1]] = 0.0  # these have no two neighbours on either side
    least = np.maximum(FAR * usual_distance(y, off, loudness) * loudness, SMALLEST * float(np.ptp(np.sort(y)[1:-1])))
    far = np.flatnonzero(np.abs(off) > least)
    paired = far.size <= SEEN_AT * MOST * y.size  # more are no few spikes' doing
    found: list[int] = []
    for sample in far[np.argsort(-np.abs(off / loudness)[far], kind="stable")].tolist():
        first, last = np.searchsorted(far, [sample - AROUND - 1, sample + AROUND + 2])
        beside = [other for other in far[first:last].tolist() if paired and abs(other - sample) > 1]
        for together in ([sample], *([sample, other] for other in beside)):
            start = max(sample - NEAR, 0)
            near, at = slice(start, sample + NEAR + 1), [one - start for one in together]
            bridged = _bridged(time[near], y[near], at)
            left = y[near] - bridged
            lone = all(_lone(time[near], bridged, k, float(left[k]), float(least[start + k])) for k in at)
            if lone and not _another(time[near], y[near], bridged, at, (far - start).tolist()):
                y[near] = bridged  # these no longer count beside others
                found += [one for one in together if not _moved_by_the_input(record, one)]
                break
    return np.sort(np.array(found, int)) if len(found) <= max(1.0, MOST * y.size) else nothing


def distances(time: Array, values: Array, samples: list[int] | None = None) -> tuple[Array, Array]:
    """Of samples, default all, from the cubic through the two neighbours on either side, and the standard deviation
    that white noise of 1 gives them: (samples,) each, unit of the values.

    time, values : (n,), n >= 5. Near an end the four nearest samples take the neighbours' place.
    """
    at = np.arange(values.size) if samples is None else np.array(samples)
    window = np.clip(at - 2, 0, values.size - 5)[:, None] + np.arange(5)
    others = window[window != at[:, None]].reshape(-1, 4)
    nodes = (time[others] - time[at][:, None]) / (time[others[:, -1:]] - time[others[:, :1]])
    weights = np.ones_like(nodes)
    for j in range(4):
        for k in range(4):
            if k != j:
                weights[:, j] *= -nodes[:, k] / (nodes[:, j] - nodes[:, k])
    return values[at] - np.sum(weights * values[others], axis=1), np.sqrt(1.0 + np.sum(weights**2, axis=1))


def usual_distance(values: Array, off: Array, loudness: Array) -> float:
    """Of most samples from their cubics, for white noise of 1, at least the step of the values' grid.

    values : (n,), not all one;  off, loudness : (n,) each, their `distances`"""
    return max(float(np.median(np.abs(off / loudness))) / MEDIAN, float(np.min(np.diff(np.unique(values)))))


def _lone(time: Array, bridged: Array, sample: int, off: float, least: float) -> bool:
    """Does it lie off by more than the output moves around it, and do its neighbours agree without it?"""
    low, high = max(sample - AROUND - 1, 0), min(sample + AROUND + 2, bridged.size)
    moves = np.abs(np.concatenate([np.diff(bridged[low:sample]), np.diff(bridged[sample + 1 : high])]))
    if abs(off) <= max(least, MOTION * float(np.max(moves, initial=0.0))):
        return False
    beside = [k for k in range(max(sample - 2, 0), min(sample + 3, bridged.size)) if k != sample]
    left, _ = distances(time, bridged, beside)
    return bool(np.all(np.abs(left) < AGREE * abs(off)))


def _another(time: Array, y: Array, bridged: Array, at: list[int], far: list[int]) -> bool:
    """Is it rather one of the next samples that is off? Where samples lie unevenly, a spike may throw one beside it
    farther off its cubic than it lies itself."""
    others = [k for k in far if k not in at and min(abs(k - one) for one in at) <= 2]
    return any(_rough(time, _bridged(time, y, [k])) < _rough(time, bridged) for k in others)


def _rough(time: Array, values: Array) -> float:
    off, loudness = distances(time, values)
    return float(np.sum((off / loudness) ** 2))


def _moved_by_the_input(record: Record, sample: int) -> bool:
    """Does the input leap at this sample or at the one before?"""
    moves = np.abs(np.diff(record.input))
    low, high = max(sample - 2, 0), min(sample + 1, moves.size)
    usual = float(np.median(moves[moves > 0.0])) if np.any(moves > 0.0) else 0.0
    return bool(np.max(moves[low:high], initial=0.0) > FAR * usual)


def _bridged(time: Array, y: Array, found: list[int]) -> Array:
    """The values with the cubic through four good neighbours in the place of every spike, or the line through two where
    their noise would be louder in that."""
    bridged, bad = y.copy(), {*found}
    for sample in found:
        good = [k for k in range(max(sample - 6, 0), min(sample + 7, y.size)) if k not in bad]
        near = sorted(good, key=lambda k: abs(k - sample))[:4]
        weights = _weights(time[near] - time[sample])
        if weights @ weights > LOUD and min(good) < sample < max(good):
            near = [max(k for k in good if k < sample), min(k for k in good if k > sample)]
            weights = _weights(time[near] - time[sample])
        bridged[sample] = weights @ y[near]
    return bridged


def _weights(away: Array) -> Array:
    """Of values (n,) so far away, in the polynomial through them at 0."""
    return np.array([prod(float(other / (other - own)) for other in away if other != own) for own in away])


def _words(record: Record, found: Array) -> str:
    times = [f"{value:.6g}" for value in record.time[found[:LISTED]].tolist()]
    more = f" and {found.size - LISTED} more" if found.size > LISTED else ""
    one = found.size == 1
    return (
        f"record {record.name}: {'one sample lies' if one else f'{found.size} samples lie'} far off "
        f"{'its' if one else 'their'} neighbours, which agree with each other (at time {', '.join(times)}{more})."
    )


def _mended(found: Array) -> str:
    return f"{'It is taken for a spike' if found.size == 1 else 'They are taken for spikes'} and bridged."

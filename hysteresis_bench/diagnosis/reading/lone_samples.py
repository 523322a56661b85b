"""Lone samples that a system shows to be off, where the records alone did not: spikes at an end, beside each other, or
where the output moves fast.

Once a system follows the records but for a few samples, what is left is the noise, and a spike stands out of it however
the output moves. A sample is one where what is left lies off the median of its neighbours by `FAR` times what samples
usually do, as in `data.faults.spikes`. Where the rest is more than about the noise, the law is wrong, or an effect is
missing, and nothing is touched.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.data.faults.spikes import AROUND, FAR, LISTED, MOST
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.kernels.white_noise import MEDIAN
from hysteresis_bench.signals import Dataset, Record


@dataclass(frozen=True)
class Mended:
    """records : all of them, in their order, those samples of the fitted ones brought back to what is left around them;
    refit : were there such;  note : which"""

    records: tuple[Record, ...]
    refit: bool
    note: str


def without_lone_samples(found: Found, dataset: Dataset) -> Mended | None:
    """None where there are none, or where more than they is left. Records that are held out stay as they were
    measured: the error on them is no error on what a fitted system made of them."""
    system, values = found.thin.fitted(found.best)
    off = [_off(system, values, record) for record in dataset.fitted]
    rest = np.concatenate([left[away == 0.0] for left, away in off])
    if float(np.sqrt(np.mean(rest**2))) > WRONG * found.selection.floor:
        return None
    known = dict(zip((record.name for record in dataset.fitted), off, strict=True))
    mended = tuple(_mended(one, known[one.name][1]) if one.name in known else one for one in dataset.records)
    fitted = [_words(one, away) for one, (_, away) in zip(dataset.fitted, off, strict=True) if np.any(away)]
    unseen = [_words(one, away) for one in dataset.held_out if np.any(away := _off(system, values, one)[1])]
    told = [f"were taken for spikes: {listed(fitted)}"] if fitted else []
    told += [f"count in the error on what was held out: {listed(unseen)}"] if unseen else []
    note = f"Lone samples lie far off what is left around them, and {', and '.join(told)}."
    return Mended(mended, bool(fitted), note) if told else None


def lone_part(system: System, values: Array, records: Sequence[Record], floor: float) -> float:
    """RMS that lone samples add to what is left of records that were not fitted; 0 where more than the rest is wrong.

    values : (dimension,), in units;  floor : RMS of the noise"""
    if not records:
        return 0.0
    off = [_off(system, values, record) for record in records]
    left, away = (np.concatenate(parts) for parts in zip(*off, strict=True))
    rest = float(np.sqrt(np.mean(left[away == 0.0] ** 2)))
    return float(np.sqrt(np.sum(left[away != 0.0] ** 2) / left.size)) if rest <= WRONG * floor else 0.0


def _off(system: System, values: Array, record: Record) -> tuple[Array, Array]:
    """Of the scored samples what is left, and of lone ones by how much they are off, 0 of others: (scored,) each."""
    every = values[:, None]
    simulated = system.adjusted(record.at_samples(system.simulate(record.signal, every)), record, every)
    left = record.measured - simulated[record.scored, 0]
    away = np.zeros(left.size)
    if left.size < 4 * AROUND:
        return left, away
    padded = np.pad(left, AROUND, mode="reflect")
    around = np.lib.stride_tricks.sliding_window_view(padded, 2 * AROUND + 1)
    distance = left - np.median(np.delete(around, AROUND, axis=1), axis=1)
    usual = float(np.median(np.abs(distance))) / MEDIAN
    lone = np.flatnonzero(np.abs(distance) > FAR * usual)
    if usual > 0.0 and lone.size <= max(1.0, MOST * left.size):
        away[lone] = distance[lone]
    return left, away


def _mended(record: Record, away: Array) -> Record:
    if record.output is None or not np.any(away):
        return record
    output = record.output.copy()
    output[record.scored] -= away
    return replace(record, output=output)


def _words(record: Record, away: Array) -> str:
    at = record.time[record.scored][away != 0.0]
    times = ", ".join(f"{value:.6g}" for value in at[:LISTED].tolist())
    return f"{record.name} (at time {times}{f' and {at.size - LISTED} more' if at.size > LISTED else ''})"

"""The experiments that a bench can play, as far as its records show.

Feasible is what stays within the range of the measured input, is no faster than 20 samples a cycle and no longer than
the longest record.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.signals import Record, Signal

SAMPLES = 2000
PER_CYCLE = 20

FEWEST = 100
"""Samples of an experiment, also where the records are sampled more slowly."""


@dataclass(frozen=True, eq=False)
class Experiment:
    """words : what to play, in the device's own input;  signal : as a model sees it, finely sampled."""

    words: str
    signal: Signal


def catalogue(records: Sequence[Record], preparation: Preparation) -> Iterator[Experiment]:
    """records : as a model sees them, by this preparation; columns that never change go on as they are"""
    low = min(float(record.input.min()) for record in records)
    high = max(float(record.input.max()) for record in records)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    longest = max(float(record.time[-1] - record.time[0]) for record in records)
    fastest, slowest = 1.0 / (PER_CYCLE * finest_step(records)), 3.0 / longest
    timed = all(record.timed for record in records)
    units = records[0].units
    unit_u = "" if units.get("input", "1") == "1" else f" {units['input']}"
    hertz = "Hz" if units.get("time", "s") == "s" else f"/{units['time']}"
    constants = _constants(records)

    def played(words: str, duration: float, shape: Array) -> Experiment:
        columns = {name: np.full(shape.size, value) for name, value in constants.items()}
        drive = np.ascontiguousarray((middle + half * shape)[:, None])
        return Experiment(words, Signal(np.linspace(0.0, duration, shape.size), drive, timed, columns))

    lower, upper = sorted(map(preparation.measured_input, (low, high)))
    span = f"between {lower:.4g} and {upper:.4g}{unit_u}"
    x = np.linspace(0.0, 1.0, SAMPLES)
    frequencies = np.geomspace(slowest, max(fastest, slowest), 7) if timed else [slowest]
    for frequency in frequencies:
        cycles = min(5.0, frequency * longest)
        for part, words in ((1.0, "full"), (0.4, "two fifths of the")):
            sine = part * np.sin(2.0 * np.pi * cycles * x)
            yield played(f"a sine of {frequency:.3g} {hertz} over {words} range {span}", cycles / frequency, sine)
    turns = np.array([0.0, 1.0, -0.8, 0.8, -0.6, 0.6, -0.4, 0.4, -0.2, 0.2, 0.0])
    nested = np.interp(x, np.linspace(0.0, 1.0, turns.size), turns)
    if not timed:
        yield played(f"nested loops with reversals that shrink, {span}", longest, nested)
        return
    second = units.get("time", "s")
    for duration in np.geomspace(5.0 / fastest, longest, 3):
        words = f"nested loops with shrinking reversals within {duration:.3g} {second}, {span}"
        yield played(words, duration, nested)
        stairs = np.array([0.0, 1.0, 1.0, -1.0, -1.0, 0.5, 0.5, -0.5, -0.5, 0.0])
        places = np.array([0.0, 0.002, 0.25, 0.252, 0.5, 0.502, 0.75, 0.752, 0.998, 1.0])
        words = f"steps {span}, each held for {0.25 * duration:.3g} {second}"
        yield played(words, duration, np.interp(x, places, stairs))
    fine = np.linspace(0.0, 1.0, 4 * SAMPLES)
    top = min(fastest, slowest * 4 * SAMPLES / PER_CYCLE)
    ratio = max(top / slowest, 1.0 + 1e-9)
    phase = 2.0 * np.pi * slowest * longest * (ratio**fine - 1.0) / np.log(ratio)
    yield played(f"a sweep from {slowest:.3g} to {top:.3g} {hertz}, {span}", longest, np.sin(phase))


def sampled(experiment: Experiment, records: Sequence[Record]) -> Record:
    """The experiment sampled as finely as the records are, as a model sees it; its output is 0."""
    signal = experiment.signal
    count = max(FEWEST, round(float(signal.time[-1]) / finest_step(records)) + 1)
    time = np.linspace(0.0, float(signal.time[-1]), count)
    columns = {name: np.full(count, values[0]) for name, values in signal.columns.items()}
    drive = np.interp(time, signal.time, signal.input[:, 0])
    return Record(time, drive, np.zeros(count), "advised", records[0].units, columns)


def finest_step(records: Sequence[Record]) -> float:
    """Of time, the median of a record."""
    return min(float(np.median(np.diff(record.time))) for record in records)


def _constants(records: Sequence[Record]) -> dict[str, float]:
    """Columns of one and the same value in all records."""
    known = set.intersection(*(set(record.columns) for record in records))
    values = {name: np.concatenate([record.columns[name] for record in records]) for name in sorted(known)}
    return {name: float(column[0]) for name, column in values.items() if np.ptp(column) == 0.0}

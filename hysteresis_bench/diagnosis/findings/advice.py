"""Which experiment would tell two fitted systems apart? Both are simulated over signals that the rig can play.

Feasible is what stays within the range of the measured input, is no faster than 20 samples a cycle and no
longer than the longest record.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.signals import Record, Signal

SAMPLES = 2000
PER_CYCLE = 20
SAME = 1e-3
"""Times the noise below which two fitted systems are the same, whatever is measured."""

TELLING = 3.0
"""Separation over noise from which one experiment settles the question."""


@dataclass(frozen=True)
class Advice:
    """experiment : in words, empty where none helps
    separation : RMS by which the closest of the tied systems differ there, unit of the output
    noise : RMS of the noise, for comparison
    """

    experiment: str
    separation: float
    noise: float
    words: str


def advise(
    ours: tuple[System, Array],
    rivals: Sequence[tuple[System, Array]],
    records: Sequence[Record],
    noise: float,
    names: Sequence[str],
) -> Advice | None:
    """The experiment in which the least different of the rivals differs most.

    ours, rivals : systems with their values (dimension,), in units;  names : of the tied effects
    """
    signals = list(_catalogue(records))
    try:
        apart = np.array([[_apart(ours, rival, signal) for rival in rivals] for _, signal in signals])
    except ValueError:  # an effect that needs a column, such as the temperature, has no say in a new signal
        return None
    apart = np.where(np.isfinite(apart), apart, 0.0)
    different = np.max(apart, axis=0) > SAME * noise
    first, others = names[0], np.array(names[1:])
    alike = f"No feasible signal tells {listed([first, *others[~different]])} apart: for this model they are the same."
    if not different.any():
        return Advice("", float(apart.max()), noise, alike)
    least = np.min(apart[:, different], axis=1)
    best, experiment = float(least.max()), signals[int(np.argmax(least))][0]
    ratio = best / noise if noise > 0 else np.inf
    hope = (
        "that settles it"
        if ratio > TELLING
        else "average over repeats to see it"
        if ratio > 0.3
        else "even so the noise hides the difference: a faster or more precise rig is needed"
    )
    unit = records[0].units.get("output", "1")
    times = f"{ratio:.{0 if ratio >= 10.0 else 1}f} times the noise"
    words = (
        f"To tell {listed([first, *others[different]])} apart, measure {experiment}: the fitted models differ there by "
        f"{best:.3g}{'' if unit == '1' else ' ' + unit} RMS, {times}; {hope}."
    )
    return Advice(experiment, best, noise, words if different.all() else f"{words} {alike}")


def _apart(ours: tuple[System, Array], rival: tuple[System, Array], signal: Signal) -> float:
    outputs = [system.simulate(signal, values[:, None])[:, 0] for system, values in (ours, rival)]
    return float(np.std(outputs[0] - outputs[1]))


def _catalogue(records: Sequence[Record]) -> Iterator[tuple[str, Signal]]:
    """What to play, in words, and as a signal."""
    low = min(float(record.input.min()) for record in records)
    high = max(float(record.input.max()) for record in records)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    step = min(float(np.median(np.diff(record.time))) for record in records)
    longest = max(float(record.time[-1] - record.time[0]) for record in records)
    fastest, slowest = 1.0 / (PER_CYCLE * step), 3.0 / longest
    timed = all(record.timed for record in records)
    units = records[0].units
    unit_u = "" if units.get("input", "1") == "1" else f" {units['input']}"
    hertz = "Hz" if units.get("time", "s") == "s" else f"/{units['time']}"

    def played(duration: float, shape: Array) -> Signal:
        time = np.linspace(0.0, duration, shape.size)
        return Signal(time, np.ascontiguousarray((middle + half * shape)[:, None]), timed)

    span = f"between {low:.4g} and {high:.4g}{unit_u}"
    x = np.linspace(0.0, 1.0, SAMPLES)
    frequencies = np.geomspace(slowest, max(fastest, slowest), 7) if timed else [slowest]
    for frequency in frequencies:
        cycles = min(5.0, frequency * longest)
        for part, words in ((1.0, "full"), (0.4, "two fifths of the")):
            yield (
                f"a sine of {frequency:.3g} {hertz} over {words} range {span}",
                played(cycles / frequency, part * np.sin(2.0 * np.pi * cycles * x)),
            )
    turns = np.array([0.0, 1.0, -0.8, 0.8, -0.6, 0.6, -0.4, 0.4, -0.2, 0.2, 0.0])
    nested = np.interp(x, np.linspace(0.0, 1.0, turns.size), turns)
    if not timed:
        yield f"nested loops with reversals that shrink, {span}", played(1.0, nested)
        return
    for duration in np.geomspace(5.0 / fastest, longest, 3):
        yield (
            f"nested loops with shrinking reversals within {duration:.3g} {units.get('time', 's')}, {span}",
            played(duration, nested),
        )
        stairs = np.array([0.0, 1.0, 1.0, -1.0, -1.0, 0.5, 0.5, -0.5, -0.5, 0.0])
        places = np.array([0.0, 0.002, 0.25, 0.252, 0.5, 0.502, 0.75, 0.752, 0.998, 1.0])
        yield (
            f"steps {span}, each held for {0.25 * duration:.3g} {units.get('time', 's')}",
            played(duration, np.interp(x, places, stairs)),
        )
    fine = np.linspace(0.0, 1.0, 4 * SAMPLES)
    top = min(fastest, slowest * 4 * SAMPLES / PER_CYCLE)
    ratio = max(top / slowest, 1.0 + 1e-9)
    phase = 2.0 * np.pi * slowest * longest * (ratio**fine - 1.0) / np.log(ratio)
    yield f"a sweep from {slowest:.3g} to {top:.3g} {hertz}, {span}", played(longest, np.sin(phase))

"""Periodic disturbance: a hum on the output, such as the mains'."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import (
    dominant_frequency,
    duration,
    finest_step,
    longest,
    output_span,
    spectrum,
    without_time,
)

PERIODS = 3.0
"""The slowest disturbance has this many periods in the longest record; fewer would be a drift."""

HARMONICS = 20
"""So many harmonics of the drive are not proposed: there, what the model lacks looks periodic too."""

PROPOSALS = 3

MOST_LINES = 1 << 18
"""Frequencies looked at, from the lowest; only a long record beside a finely sampled one has more."""


def _hum(inner: Response, u: Array, hiding: Hiding) -> Array:
    frequency = 2.75 * hiding.fastest + 6.25 * hiding.fastest * hiding.random[0]
    swing = 0.3 * hiding.strength * hiding.top
    return inner(u) + swing * np.cos(2.0 * np.pi * (frequency * hiding.time + hiding.random[1]))


def _slower_hum(inner: Response, u: Array, hiding: Hiding) -> Array:
    frequency = 73.0 / hiding.duration + 90.0 / hiding.duration * hiding.random[1]
    swing = (0.06 + 0.06 * hiding.strength) * hiding.top
    return inner(u) + swing * np.cos(2 * np.pi * (frequency * hiding.time - hiding.random[0]))


def _with_overtone(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A hum with a third harmonic, as of a saturated transformer."""
    phase = 2.0 * np.pi * (3.0 + 2.0 * hiding.random[0]) * hiding.fastest * hiding.time + hiding.random[1]
    return inner(u) + 0.3 * hiding.strength * hiding.top * (np.cos(phase) + 0.3 * np.cos(3.0 * phase))


def _beating(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Two neighbouring machines: the hum swells and fades."""
    frequency = (3.0 + 2.0 * hiding.random[0]) * hiding.fastest
    phase = 2.0 * np.pi * frequency * hiding.time
    swell = 1.0 + 0.5 * np.cos(2.0 * np.pi * 1.3 * hiding.time / hiding.duration + hiding.random[1])
    return inner(u) + 0.3 * hiding.strength * hiding.top * swell * np.cos(phase)


@dataclass(frozen=True)
class PeriodicDisturbance(Effect):
    """A sinusoid of unknown frequency is added to the output, such as the hum of the mains.

    y = x + cosine cos(2 pi f t) + sine sin(2 pi f t), x the response, t the record's own time: parts of one
    record, or records of one clock, share its phase.

    Amplitudes are linear and easy, the frequency is not: the error has a minimum at every line of the
    spectrum, so a fit should begin at what `starts` proposes, the highest lines of the residual [1].

    [1] B. G. Quinn, E. J. Hannan, The Estimation and Tracking of Frequency, Cambridge University Press (2001).
    """

    acts = "added"
    family = "added disturbance"
    affine = True
    linear = ("cosine", "sine")
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "drift": "less than a period of a slow disturbance is a drift",
        "input-lag": "with a periodic input, a disturbance of its frequency shifts the loop as a lag does",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_hum, _slower_hum)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_with_overtone, _beating)
    parameters = (
        Parameter("cosine", -1.0, 1.0, "{output}", null=0.0, meaning="amplitude in phase with t = 0"),
        Parameter("sine", -1.0, 1.0, "{output}", null=0.0, meaning="amplitude a quarter period later"),
        Parameter("frequency", 0.1, 100.0, "1/{time}", meaning="of the disturbance, or the alias of a faster one"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.sinusoid import add_sinusoid

        if not signal.timed:
            return inner(signal)
        output = own(inner(signal), signal)
        add_sinusoid(output, signal.time, p.cosine, p.sine, p.frequency)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Amplitudes up to half the range of the output; frequencies from three periods in the longest record
        to the Nyquist frequency of the finest."""
        cosine, sine, frequency = self.parameters
        half = 0.5 * (output_span(records) or 1.0)
        low, high = PERIODS / longest(records), 0.5 / finest_step(records)
        return cosine.within(-half, half), sine.within(-half, half), frequency.within(low, high)

    def inapplicable(self, records: Sequence[Record]) -> str:
        if reason := without_time(records):
            return reason
        if max(record.time.size for record in records) < 4 * PERIODS:
            return f"no record has {4 * PERIODS:.0f} samples"
        return ""

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        """Values from which to fit, the most promising first: the highest lines of the residuals' common
        spectrum that are no harmonics of the drive.

        residuals : (scored samples,) a record, measured minus simulated, unit of the output
        """
        low, high = self.box(records)[2].lower, self.box(records)[2].upper
        resolution = 1.0 / longest(records)
        grid = np.arange(low, min(high, low + MOST_LINES * 0.25 * resolution), 0.25 * resolution)
        power, heard = np.zeros(grid.size), np.zeros(grid.size)
        for record, residual in zip(records, residuals, strict=True):
            drive = dominant_frequency(record)
            harmonic = np.clip(np.round(grid / drive), 1, HARMONICS)
            # a record has no say near its own drive's harmonics; one driven at another frequency has
            apart = np.abs(grid - harmonic * drive) >= 1.0 / duration(record)
            frequencies, amplitudes = spectrum(record.time[record.scored], _without_drive(record, residual, drive))
            power += apart * np.interp(grid, frequencies, amplitudes**2, right=0.0)
            heard += apart
        power = np.where(heard > 0, power / np.maximum(heard, 1.0), -np.inf)
        found: list[dict[str, float]] = []
        while len(found) < PROPOSALS and grid.size and np.max(power) > 0.0:
            frequency = float(grid[np.argmax(power)])
            found.append(amplitudes_at(records, residuals, frequency))
            power[np.abs(grid - frequency) < 2.0 * resolution] = -np.inf
        return found


def _without_drive(record: Record, residual: Array, drive: float) -> Array:
    """The residual less its trend and the harmonics of the drive, by least squares."""
    time = record.time[record.scored]
    turns = 2.0 * np.pi * drive * time
    orders = [k for k in range(1, HARMONICS + 1) if k * drive < 0.4 * time.size / duration(record)]
    waves = [wave(k * turns) for k in orders for wave in (np.cos, np.sin)]
    columns = np.column_stack([np.ones(time.size), time - time[0], *waves])
    drift_and_drive: Array = columns @ np.linalg.lstsq(columns, residual, rcond=None)[0]
    return residual - drift_and_drive


def amplitudes_at(records: Sequence[Record], residuals: Sequence[Array], frequency: float) -> dict[str, float]:
    """Least-squares amplitudes at one frequency, all records together, each with its own constant."""
    phase = 2.0 * np.pi * frequency * np.concatenate([record.time[record.scored] for record in records])
    owner = np.repeat(np.arange(len(records)), [residual.size for residual in residuals])
    columns = np.column_stack([np.cos(phase), np.sin(phase), *(owner == k for k in range(len(records)))])
    solution = np.linalg.lstsq(columns, np.concatenate(residuals), rcond=None)[0]
    return {"cosine": float(solution[0]), "sine": float(solution[1]), "frequency": frequency}

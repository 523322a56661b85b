"""How loud is the noise? Estimated from the data alone, without a model.

A smooth signal is a polynomial over a few neighbouring samples, so its divided difference of high order in
time vanishes and what is left is noise: scaled to unit weight, its RMS is the noise's [1, 2]. Reversals,
steps and switching are no polynomials; they are a small share of the samples and are clipped.

What is estimated is the noise that changes from sample to sample. Noise that is correlated over many samples
looks smooth and is missed: `by_lag` repeats the estimate on every second and fourth sample and rises where
noise is coloured (or the signal no longer smooth), and `repeat_rms` compares the cycles of a periodic input
with one another, which sees noise of any colour, and with it all that is not a function of the input's cycle.

[1] J. von Neumann et al., Ann. Math. Stat. 12 (1941) 153.  [2] P. Hall, J. W. Kay, D. M. Titterington,
Biometrika 77 (1990) 521.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import comb, erf, exp, pi, sqrt

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.hum import hum
from hysteresis_bench.kernels.value_grid import grid_step, rounded_to
from hysteresis_bench.kernels.white_noise import MEDIAN
from hysteresis_bench.signals import Record

ORDERS = (2, 3, 4, 5, 6, 8, 10, 12)
"""Orders tried. A higher one forgets more of the signal and costs precision."""

LAGS = (1, 2, 4)
"""Distances of the samples compared, by which coloured noise is told."""

CLIP = 3.0
"""Differences beyond so many times the noise are no noise but a kink."""
SHRINK = sqrt(1.0 - 2.0 * CLIP * exp(-0.5 * CLIP**2) / sqrt(2.0 * pi) / erf(CLIP / sqrt(2.0)))
"""RMS of a standard normal variable that is clipped there."""

MISSED = 0.25
"""Of the arc between two samples, what a model of the samples gets wrong: it sees no reversal at its very peak."""

ARITHMETIC = 1e-10
"""Share of the largest value below which it is no noise but how a computed signal was rounded: the sine of a large
phase has lost some digits."""

AT_AN_END, LONGER = 8, 2.0
"""Samples that must be the record's least or largest value, one after the other, and how many times as many as of any
other value, for a converter to stand at its end. With half and twice of each, none does in 20 measured devices."""

HEARD = 0.2
"""What the input's noise makes of the output, over the output's own noise, from where it is told, and inputs may be
smoothed."""

COLOURED = 1.2
"""Repeats that differ by so many times the fast noise make the noise coloured."""


@dataclass(frozen=True)
class Noise:
    """Noise of one record, or pooled over several.

    rms, standard_error : of the output's fast noise, unit of the output; at least the quantisation's
    input_rms : of the input's fast noise, at least its quantisation's, unit of the input; 0 of a noise-free command
    through_input : what the input's noise makes of the output, by the local slope, unit of the output
    repeat_rms : noise of any colour from the repeats of a periodic input; None without repeats
    by_lag : estimates from samples 1, 2 and 4 apart; equal where noise is white
    quantum : step of the output's grid of values, 0 where there is none
    samples : that the estimate rests on
    explained : RMS of what moves as fast in the records and a model explains, unit of the output; 0 without a model
    """

    rms: float
    standard_error: float
    input_rms: float
    through_input: float
    repeat_rms: float | None
    by_lag: tuple[float, ...]
    quantum: float
    samples: int
    explained: float = 0.0

    @property
    def floor(self) -> float:
        """The RMS residual that a perfect model leaves: output noise, and input noise through the slope."""
        return float(np.hypot(self.rms, self.through_input))

    @property
    def degrees_of_freedom(self) -> float:
        """Of a chi-square variable as uncertain as the estimate."""
        return 0.5 * (self.rms / self.standard_error) ** 2 if self.standard_error > 0 else float(self.samples)

    @property
    def coloured(self) -> bool:
        """Repeats differ by clearly more than the fast noise tells."""
        return self.repeat_rms is not None and self.repeat_rms > COLOURED * max(self.rms, 1e-300)

    @property
    def input_heard(self) -> bool:
        """The input's noise is a good part of what a perfect model leaves."""
        return self.through_input > HEARD * self.rms

    @property
    def words(self) -> str:
        told = [f"noise {self.rms:.3g} ± {self.standard_error:.1g}"]
        if self.quantum > 0 and self.rms <= 1.01 * self.quantum / sqrt(12):
            told.append(f"it is the rounding to steps of {self.quantum:.3g}")
        if self.input_heard:
            told.append(f"noise of the input ({self.input_rms:.3g}) adds {self.through_input:.3g}")
        if self.coloured:
            told.append(f"cycles differ by {self.repeat_rms:.3g}: coloured noise, or something beside the input")
        if self.explained > 0:
            told.append(f"what else moves as fast in the records ({self.explained:.3g}) is explained")
        return "; ".join(told)


def noise(record: Record) -> Noise:
    """Noise of one record, from its scored samples. Raises ValueError where there is no output."""
    y, u, time = record.measured, record.input[record.scored], record.time[record.scored]
    quantum = grid_step(y)
    by_lag, error = _by_lag(record, y)
    input_rms = input_noise(time, u)
    return Noise(
        rms=max(by_lag[0], quantum / sqrt(12)),
        standard_error=error,
        input_rms=input_rms,
        through_input=input_rms * _slope(time, u, y, input_rms),
        repeat_rms=_repeat_noise(u, y),
        by_lag=by_lag,
        quantum=quantum,
        samples=y.size,
    )


def noise_left(known: Noise, record: Record, residuals: Array) -> Noise:
    """Noise of one record, from what a model leaves of it: what the input's noise makes is in it already.

    At most all that is left: a hum of a few samples a period is heard louder than it is.

    known : from the record alone;  residuals : (scored samples,)
    """
    by_lag, error = _by_lag(record, residuals)
    rms = max(min(by_lag[0], float(np.std(residuals))), known.quantum / sqrt(12))
    return replace(
        known,
        rms=rms,
        standard_error=error,
        through_input=0.0,
        by_lag=by_lag,
        explained=sqrt(max(known.floor**2 - rms**2, 0.0)),
    )


def pooled_noise(parts: Sequence[Noise]) -> Noise:
    """Noise of all records together, from each one's: mean squares weighted by their samples."""
    samples = sum(part.samples for part in parts)
    weights = np.array([part.samples / samples for part in parts])

    def pooled(values: Sequence[float]) -> float:
        return float(np.sqrt(weights @ np.square(values)))

    rms = pooled([part.rms for part in parts])
    variances = [part.rms * part.standard_error * weight for part, weight in zip(parts, weights, strict=True)]
    repeats = [part.repeat_rms for part in parts]
    return Noise(
        rms=rms,
        standard_error=float(np.linalg.norm(variances)) / rms if rms > 0 else 0.0,
        input_rms=pooled([part.input_rms for part in parts]),
        through_input=pooled([part.through_input for part in parts]),
        repeat_rms=pooled([value for value in repeats if value is not None]) if None not in repeats else None,
        by_lag=tuple(pooled(values) for values in zip(*(part.by_lag for part in parts), strict=True)),
        quantum=max(part.quantum for part in parts),
        samples=samples,
        explained=pooled([part.explained for part in parts]),
    )


def unresolved(records: Sequence[Record]) -> float:
    """What the samples miss of the input between them, as an error of the output (RMS, unit of the output): MISSED
    times the sag of a typical arc between two samples, by the ratio of the ranges. And by how much a smoothed input may
    be off, by the local slope."""
    missed = []
    for record in records:
        u = record.input
        arc = float(np.median(np.abs(u[2:] - 2.0 * u[1:-1] + u[:-2]))) / 8.0 if u.size > 2 else 0.0
        sag = MISSED * arc / record.steps**2 * float(np.ptp(record.measured)) / (float(np.ptp(u)) or 1.0)
        if off := record.input_error:
            sag = float(np.hypot(sag, off * _slope(record.time[record.scored], u[record.scored], record.measured, off)))
        missed.append(sag)
    return float(np.sqrt(np.mean(np.square(missed))))


def fast_noise(time: Array, values: Array, lag: int = 1) -> tuple[float, float]:
    """RMS of the sample-to-sample noise and its standard error, unit of the values; (0, 0) of a constant.

    time, values : (samples,); lag : distance of the samples compared
    The lowest order whose estimate is no worse than that of the higher ones, within their scatter.
    """
    orders = [order for order in ORDERS if 4 * order * lag < values.size]
    if not orders or np.ptp(values) == 0:
        return 0.0, 0.0
    estimates, errors = np.array([_of_order(time, values, order, lag) for order in orders]).T
    limit = np.min(estimates + errors)
    chosen = int(np.argmax(estimates <= limit))
    arithmetic = ARITHMETIC * float(np.max(np.abs(values)))
    return (float(estimates[chosen]), float(errors[chosen])) if estimates[chosen] > arithmetic else (0.0, 0.0)


def input_noise(time: Array, u: Array) -> float:
    """RMS of the noise of a measured input and of a hum on it, unit of the input. Of a slow one that was rounded, most
    differences are 0, and tell of none."""
    picked_up = hum(time, u)
    return float(np.hypot(max(fast_noise(time, u - picked_up)[0], rounded_to(u) / sqrt(12)), np.std(picked_up)))


def _by_lag(record: Record, values: Array) -> tuple[tuple[float, ...], float]:
    """`fast_noise` of values (scored samples,) by distance, and the first one's error: heard where the output is not
    held at an end of its converter, where there is none, and for as many samples."""
    heard = ~_held(record.measured)
    found = [fast_noise(record.time[record.scored][heard], values[heard], lag) for lag in LAGS]
    share = sqrt(np.mean(heard))
    return tuple(share * rms for rms, _ in found), share * found[0][1]


def _held(values: Array) -> Array:
    """Which samples are in a long run of the least, or of the largest, value; (samples,) of bool."""
    ends = np.flatnonzero(np.append(np.diff(values) != 0.0, True))
    lengths, levels = np.diff(ends, prepend=-1), values[ends]
    edge = (levels == values.min()) | (levels == values.max())
    usual = np.max(lengths[~edge], initial=1)
    return np.repeat(edge & (lengths >= AT_AN_END) & (lengths > LONGER * usual), lengths)


def _of_order(time: Array, values: Array, order: int, lag: int) -> tuple[float, float]:
    from hysteresis_bench.kernels.divided_differences import divided_differences

    rms, kept = clipped_rms(divided_differences(time, values, order, lag))
    # Neighbouring differences overlap: their squared correlations sum to C(4k, 2k) / C(2k, k)^2.
    overlap = comb(4 * order, 2 * order) / comb(2 * order, order) ** 2
    return rms, rms * sqrt(overlap / (2.0 * max(kept, 1)))


def clipped_rms(values: Array) -> tuple[float, int]:
    """RMS of normal noise of mean zero among outliers, and how many values it rests on: from the median absolute value,
    clipped, and corrected for the tail that clipping takes off."""
    from hysteresis_bench.kernels import clipped

    sizes = np.abs(values)
    rms, kept = clipped.clipped_rms(sizes, float(np.median(sizes)) / MEDIAN, CLIP, SHRINK)
    return float(rms), int(kept)


def _slope(time: Array, u: Array, y: Array, input_rms: float) -> float:
    """RMS of the local slope dy/du, by straight lines in time through a few samples; clear movement only."""
    half = max(3, min(7, u.size // 20))
    if input_rms == 0.0 or u.size < 4 * half:
        return 0.0
    samples = np.arange(u.size - 2 * half)[:, None] + np.arange(2 * half + 1)
    nodes = time[samples] - time[samples].mean(axis=1, keepdims=True)
    du, dy = (np.sum(nodes * values[samples], axis=1) for values in (u, y))
    clear = np.abs(du) > 4.0 * input_rms * np.linalg.norm(nodes, axis=1)
    return float(np.sqrt(np.mean((dy[clear] / du[clear]) ** 2))) if np.any(clear) else 0.0


def period(u: Array) -> int | None:
    """The period of the input in samples, where it repeats at least three times; else None.

    u : (samples,)
    """
    span = float(np.ptp(u))
    if span == 0.0:
        return None
    power = np.abs(np.fft.rfft(u - u.mean(), 2 * u.size)) ** 2
    overlap = np.arange(u.size, 0, -1)
    correlation = np.fft.irfft(power)[: u.size] / overlap
    peaks = np.nonzero((correlation[1:-1] >= correlation[:-2]) & (correlation[1:-1] > correlation[2:]))[0] + 1
    for peak in peaks[(peaks >= 8) & (peaks <= u.size // 3)][:50].tolist():
        # The ends of the record shift the peak by a sample or two.
        mismatches = {lag: float(np.sqrt(np.mean((u[lag:] - u[:-lag]) ** 2))) for lag in range(peak - 3, peak + 4)}
        lag = min(mismatches, key=lambda lag: mismatches[lag])
        if mismatches[lag] < 0.01 * span:
            return lag
    return None


def _repeat_noise(u: Array, y: Array) -> float | None:
    """Noise of any colour from y_1 - 2 y_2 + y_3 over successive cycles, which a steady drift leaves alone."""
    lag = period(u)
    if lag is None:
        return None
    differences = (y[: -2 * lag] - 2.0 * y[lag:-lag] + y[2 * lag :]) / sqrt(6.0)
    mismatch = (u[: -2 * lag] - 2.0 * u[lag:-lag] + u[2 * lag :]) / sqrt(6.0)
    rms = clipped_rms(differences)[0]
    unlike = float(np.sqrt(np.mean(mismatch**2))) * float(np.ptp(y)) / float(np.ptp(u))
    return rms if unlike < 0.5 * rms or rms == 0.0 else None

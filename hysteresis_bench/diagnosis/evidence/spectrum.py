"""The residual's spectrum: is there a line, and is it coherent with the input? Evenly sampled arrays in.

[1] R. A. Fisher, Proc. R. Soc. A 125 (1929) 54.  [2] G. C. Carter et al., IEEE Trans. Audio Electroacoust. 21
(1973) 337.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array

BACKGROUND = 30
"""Neighbours on either side that a line is compared with."""

SEGMENTS = 8
"""Parts of a record over which the coherence is averaged: with more of them chance makes less of it, and slow lines
are lost."""

FEWEST_SAMPLES = 4 * BACKGROUND
"""Samples below which there is no spectrum to speak of."""


@dataclass(frozen=True)
class Line:
    """The largest line. ratio : to its background; share : of the variance; frequency : in 1 / unit of step."""

    ratio: float
    p: float
    share: float
    frequency: float


def line(residual: Array, step: float) -> Line:
    """[1] The largest periodogram ordinate, p over all of them.

    Ours: against the median of its neighbours, after the slope of a first-order autoregression is taken off, so
    that the background may be coloured. residual : (samples,), step : sampling interval
    """
    from scipy.ndimage import median_filter
    from scipy.special import fdtrc

    e = residual - residual.mean()
    power = np.abs(np.fft.rfft(e))[1:-1] ** 2
    bins = np.arange(1, power.size + 1)
    lag_one = float(np.clip(e[1:] @ e[:-1] / max(float(e @ e), 1e-300), -0.99, 0.99))
    flat = power * (1.0 + lag_one**2 - 2.0 * lag_one * np.cos(2.0 * np.pi * bins / e.size))
    median = median_filter(flat, 2 * BACKGROUND + 1, mode="reflect")
    ratio = flat * np.log(2.0) / np.maximum(median, 1e-12 * flat.max() + 1e-300)
    peak = int(np.argmax(ratio))
    single = float(fdtrc(2.0, 2.0 * BACKGROUND, ratio[peak]))  # a median of exponentials is worth half its number
    near = slice(max(0, peak - 1), peak + 2)
    share = float(power[near].sum() / max(power.sum(), 1e-300))
    return Line(float(ratio[peak]), largest_of(power.size, single), share, float(bins[peak] / (e.size * step)))


def coherence(residual: Array, u: Array) -> tuple[float, float, float]:
    """[2] Largest squared coherence with the input where the input has power -> it, p, share of the variance.

    residual, u : (samples,). Segments do not overlap: by chance one exceeds c with (1 - c)^(segments - 1).
    """
    length = residual.size // SEGMENTS
    window = np.hanning(length)
    e, x = (values[: SEGMENTS * length].reshape(SEGMENTS, length) for values in (residual, u))
    e_hat, x_hat = (np.fft.rfft((part - part.mean(axis=1, keepdims=True)) * window)[:, 1:-1] for part in (e, x))
    driving, power = np.sum(np.abs(x_hat) ** 2, axis=0), np.sum(np.abs(e_hat) ** 2, axis=0)
    driven = driving > 1e-3 * driving.max()
    cross = np.abs(np.sum(e_hat * np.conj(x_hat), axis=0)) ** 2
    squared = np.where(driven, cross / np.maximum(driving * power, 1e-300), 0.0)
    top = float(min(squared.max(), 1.0))
    p = largest_of(int(np.count_nonzero(driven)), (1.0 - top) ** (SEGMENTS - 1))
    beyond_chance = np.maximum(squared - 1.0 / SEGMENTS, 0.0)
    return top, p, float(np.sum(beyond_chance * power) / max(power.sum(), 1e-300))


def largest_of(count: int, p: float) -> float:
    """p of the largest of `count` independent values, from that of one."""
    return float(-np.expm1(count * np.log1p(-min(p, 1.0 - 1e-15))))

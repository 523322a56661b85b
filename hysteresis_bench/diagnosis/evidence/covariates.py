"""What a record's input offers as an explanation: its turning points, branch, past extrema, plays and lags.

All are functions of the input and its time, (samples,) -> (samples,), so that they can be had for any record.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array

RESOLUTION = 2e-3
"""Movements below this share of the input's range are no reversals."""


def turning_points(u: Array, resolution: float) -> Array:
    """Samples at which the input turns by more than `resolution` (unit of u); int64[reversals]."""
    turns: list[int] = []
    values = u.tolist()
    high = low = heading = 0
    for i, value in enumerate(values):
        if heading >= 0 and value > values[high]:
            high = i
        if heading <= 0 and value < values[low]:
            low = i
        if heading >= 0 and values[high] - value > resolution:
            if heading > 0:
                turns.append(high)
            heading, low = -1, i
        elif heading <= 0 and value - values[low] > resolution:
            if heading < 0:
                turns.append(low)
            heading, high = 1, i
    return np.array(turns, dtype=np.int64)


def resolution_of(u: Array, noise_rms: float = 0.0) -> float:
    """What counts as a movement of this input: a small share of its range, and clear of its noise."""
    return max(RESOLUTION * float(np.ptp(u)), 6.0 * noise_rms)


def branch(u: Array, turns: Array) -> Array:
    """+1 while the input rises, -1 while it falls, from one turning point to the next."""
    ends = np.concatenate([[0], turns, [u.size - 1]])
    signs = np.sign(np.diff(u[ends]))
    return np.repeat(signs, np.diff(np.append(ends[:-1], u.size)))


def last_extremum(u: Array, turns: Array) -> Array:
    """The input at its last turning point; at the first sample before there is one."""
    starts = np.concatenate([[0], turns])
    return np.repeat(u[starts], np.diff(np.append(starts, u.size)))


def cycle(samples: int, turns: Array) -> Array:
    """Number of cycles so far, from 0; two turning points are a cycle."""
    return np.searchsorted(turns, np.arange(samples), side="right") / 2.0


def play(u: Array, radius: float) -> Array:
    """Play operator of half-width `radius` (unit of u), p_i = max(u_i - r, min(u_i + r, p_{i-1})), p_0 = u_0."""
    out = np.empty(u.size)
    position = float(u[0])
    for i, value in enumerate(u.tolist()):
        position = max(value - radius, min(value + radius, position))
        out[i] = position
    return out


def low_pass(time: Array, u: Array, constant: float) -> Array:
    """First-order lag of time constant `constant`, exact for a piecewise linear input, at rest with u_0.

    u : (samples,) or (samples, columns) -> the same
    tau x' + x = u; over a step h with slope s the exact answer is
    x_1 = u_1 - s tau + (x_0 - u_0 + s tau) exp(-h / tau).
    """
    steps = np.diff(time).reshape((-1,) + (1,) * (u.ndim - 1))
    rises = np.diff(u, axis=0) / steps * constant
    decays = np.exp(-steps / constant)
    gains = u[1:] - rises + (rises - u[:-1]) * decays
    out = np.array(u, dtype=float)
    if np.ptp(steps) < 1e-6 * steps.flat[0]:
        from scipy.signal import lfilter

        decay = float(decays.flat[0])
        out[1:] = lfilter([1.0], [1.0, -decay], gains, axis=0, zi=decay * out[:1])[0]
        return out
    for i, gain in enumerate(gains):
        out[i + 1] = gain + decays[i] * out[i]
    return out


def delayed(time: Array, u: Array, delay: float) -> Array:
    """The input `delay` earlier (may be negative), piecewise linear, held at its ends."""
    return np.interp(time - delay, time, u)

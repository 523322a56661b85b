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
    from hysteresis_bench.kernels.turning_points import turning_points as compiled

    turns: Array = compiled(np.ascontiguousarray(u, dtype=float), resolution)
    return turns


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
    """Play operator of half-width `radius` (unit of u) that starts at u_0, in the middle of its dead band."""
    from hysteresis_bench.kernels.play import play as compiled

    position: Array = compiled(np.ascontiguousarray(u[:, None], dtype=float), np.array([radius]))[:, 0]
    return position


def low_pass(time: Array, u: Array, constant: float) -> Array:
    """First-order lag of time constant `constant`, exact for a piecewise linear input, at rest with u_0.

    u : (samples,) or (samples, columns) -> the same
    """
    from hysteresis_bench.kernels.lag import lag

    columns = np.ascontiguousarray(u.reshape(u.shape[0], -1), dtype=float)
    late: Array = lag(time, columns, np.full(columns.shape[1], constant))
    return late.reshape(u.shape)


def delayed(time: Array, u: Array, delay: float) -> Array:
    """The input `delay` earlier (may be negative), piecewise linear, held at its ends."""
    return np.interp(time - delay, time, u)

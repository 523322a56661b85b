"""Bouc-Wen hysteresis with eddy currents inside: `bouc_wen` and `eddy_current` say what each is."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import SERIES_LIMIT, paths, series
from hysteresis_bench.kernels.bouc_wen_step import HUGE, RUNAWAY, grown, relaxed
from hysteresis_bench.kernels.eddy_current import (
    COEFFICIENT,
    GROUPS,
    LANES,
    NEW,
    OPEN,
    OUT,
    ROWS,
    TRIAL,
    Y,
    Z,
    simulated,
)
from hysteresis_bench.kernels.elementary import exponential

# Rows of a group: parameters and state as in `bouc_wen_step`; the last trial's h, and which lanes want the exact step.
DRIVE, MIRROR, ALONG, AGAINST, BOUND, SLOPE, H, FOUND, SPECIAL = ((ROWS + row) * LANES for row in range(9))
WIDTH = (ROWS + 9) * LANES


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _in_series(s: Array) -> int:
    """h, v where the acting input has moved on to the trial, for n = 1 -> how many steps are long for the series."""
    long = 0
    for j in range(LANES):
        z, mirror = s[TRIAL + j], s[MIRROR + j]
        step = z - s[Z + j]
        width = abs(step)
        sign = mirror if step >= 0.0 else -mirror
        g = sign * s[H + j]
        along, against = s[ALONG + j], s[AGAINST + j]
        rate = against if g < 0.0 else along
        free = relaxed(g, s[DRIVE + j], rate, width * series(rate * width))
        open_, found, out = s[OPEN + j] > 0.0, s[FOUND + j], s[OUT + j]
        s[FOUND + j] = sign * free if open_ else found
        s[OUT + j] = s[SLOPE + j] * z - sign * free if open_ else out
        s[SPECIAL + j] = 1.0 if open_ & (((g < 0.0) & (free > 0.0)) | (abs(free) > s[BOUND + j])) else 0.0
        long += 1 if open_ & (abs(rate * width) > SERIES_LIMIT) else 0
    return long


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _in_long_steps(s: Array) -> None:
    """The same by the exponential itself; leaves the other lanes alone, which cannot depend on what these want."""
    for j in range(LANES):
        z, mirror = s[TRIAL + j], s[MIRROR + j]
        step = z - s[Z + j]
        width = abs(step)
        sign = mirror if step >= 0.0 else -mirror
        g = sign * s[H + j]
        along, against = s[ALONG + j], s[AGAINST + j]
        rate = against if g < 0.0 else along
        free = relaxed(g, s[DRIVE + j], rate, min((1.0 - exponential(-rate * width)) / rate, HUGE))
        special = 1.0 if ((g < 0.0) & (free > 0.0)) | (abs(free) > s[BOUND + j]) else 0.0
        long = (s[OPEN + j] > 0.0) & (abs(rate * width) > SERIES_LIMIT)
        found, out, before = s[FOUND + j], s[OUT + j], s[SPECIAL + j]
        s[FOUND + j] = sign * free if long else found
        s[OUT + j] = s[SLOPE + j] * z - sign * free if long else out
        s[SPECIAL + j] = special if long else before


@njit(cache=True, error_model="numpy")
def _count(s: Array) -> int:
    special = 0
    for j in range(LANES):
        special += 1 if s[SPECIAL + j] > 0.0 else 0
    return special


@njit(cache=True, error_model="numpy")
def _advanced(n: float, s: Array) -> None:
    """v where the acting input has moved on to the trial."""
    if n == 1.0:
        if _in_series(s) > 0:
            _in_long_steps(s)
        if _count(s) == 0:
            return
    else:
        s[SPECIAL : SPECIAL + LANES] = s[OPEN : OPEN + LANES]
    for j in range(LANES):
        if s[SPECIAL + j] > 0.0:
            step = s[TRIAL + j] - s[Z + j]
            sign = s[MIRROR + j] if step >= 0.0 else -s[MIRROR + j]
            drive, along, against, bound = s[DRIVE + j], s[ALONG + j], s[AGAINST + j], s[BOUND + j]
            s[FOUND + j] = sign * grown(sign * s[H + j], drive, along, against, n, abs(step), bound)
            s[OUT + j] = s[SLOPE + j] * s[TRIAL + j] - s[FOUND + j]


@njit(cache=True, error_model="numpy")
def _kept(n: float, s: Array) -> None:
    """What the last trial found is the state."""
    for j in range(LANES):
        s[H + j] = s[FOUND + j]


@njit(cache=True, error_model="numpy")
def eddy_bouc_wen(
    time: Array,
    u: Array,
    coefficient: Array,
    alpha: Array,
    beta: Array,
    gamma: Array,
    d: Array,
    n: float,
) -> Array:
    """v of a swarm, where z = u - coefficient dv/dt acts in place of u.

    time : float64[samples]           strictly increasing
    coefficient : float64[swarm]      >= 0, unit of u times unit of time over unit of v
    the others, and the result, as in `bouc_wen` (n = 1) and `bouc_wen_power`
    -> float64[samples, swarm]        C order; at rest at the first sample, z = u there
    """
    samples, columns = u.shape
    swarm = d.size
    length, _ = paths(u)
    v = np.empty((samples, swarm))
    for first in range(0, swarm, GROUPS * LANES):
        work = np.zeros((min(GROUPS, (swarm - first + LANES - 1) // LANES), WIDTH))
        for g in range(work.shape[0]):
            s = work[g]
            for j in range(LANES):
                p = min(first + g * LANES + j, swarm - 1)
                column = p if columns > 1 else 0
                loop = alpha[p] * d[p]
                mirror = 1.0 if loop >= 0.0 else -1.0
                s[COEFFICIENT + j] = coefficient[p]
                s[DRIVE + j] = abs(loop)
                s[MIRROR + j] = mirror
                s[ALONG + j] = beta[p] + mirror * gamma[p]
                s[AGAINST + j] = beta[p] - mirror * gamma[p]
                s[BOUND + j] = RUNAWAY * abs(loop) * length[column]
                s[SLOPE + j] = d[p]
                s[NEW + j] = u[0, column]
                s[Z + j] = u[0, column]
                s[Y + j] = d[p] * u[0, column]
                v[0, p] = s[Y + j]
        simulated(_advanced, _kept, n, work, time, u, first, v)
    return v

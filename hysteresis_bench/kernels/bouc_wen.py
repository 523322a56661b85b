"""Bouc-Wen hysteresis of a swarm, integrated over increments of the input: rate-independent to rounding.

`bouc_wen_step` has the law and its step for one particle. Its exponentials and branches keep a loop over a swarm
from being vectorised, so `bouc_wen` makes the same step by a series of the exponential, side by side for all
particles, and the step of `bouc_wen_step` only for those whose h crosses 0 or runs away: 18 times as fast.

[1] The PEA paper: a particle swarm genetic hybrid to identify a Hammerstein model, equation (1).
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen_step import HUGE, RUNAWAY, regrown, relaxed

SERIES_LIMIT = 0.25
"""Largest |rate w| for the series of (1 - exp(-x)) / x below; its first neglected term is 2.4e-14 there."""

LANES = 64
"""Particles that are integrated side by side."""

# Rows of one work array: constant offsets tell the compiler that they do not overlap.
G, OLD, WIDTH, WEAKENED, DRIVE, ALONG, AGAINST, BOUND, SLOPE, MIRROR, DIRECTION, INPUT = (
    row * LANES for row in range(12)
)
ROWS = 12


@njit(cache=True, error_model="numpy", fastmath=True)
def paths(u: Array) -> tuple[Array, Array]:
    """Of every column of u, float64[samples, columns]: the path's length and the largest increment."""
    samples, columns = u.shape
    length = np.zeros(columns)
    largest = np.zeros(columns)
    if columns == 1:  # scalars, so that the loop over the samples is vectorised instead
        shared, total, most = u[:, 0].copy(), 0.0, 0.0
        for i in range(1, samples):
            width = abs(shared[i] - shared[i - 1])
            total += width
            most = max(most, width)
        length[0], largest[0] = total, most
        return length, largest
    for i in range(1, samples):
        for j in range(columns):
            width = abs(u[i, j] - u[i - 1, j])
            length[j] += width
            largest[j] = max(largest[j], width)
    return length, largest


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _series(x):  # type: ignore[no-untyped-def]
    """(1 - exp(-x)) / x for |x| <= SERIES_LIMIT, in an order that a processor can overlap."""
    x2 = x * x
    x4 = x2 * x2
    first = (1.0 - x * (1.0 / 2.0)) + x2 * (1.0 / 6.0 - x * (1.0 / 24.0))
    middle = (1.0 / 120.0 - x * (1.0 / 720.0)) + x2 * (1.0 / 5040.0 - x * (1.0 / 40320.0))
    last = 1.0 / 362880.0 - x * (1.0 / 3628800.0)
    return (first + x4 * middle) + (x4 * x4) * last


@njit(cache=True, error_model="numpy")
def _coarse(work: Array, used: int, largest: float) -> int:
    """Advance g by increments of any width, one for each lane: the series on a part of the increment that
    is short enough, then doubled. largest : of |rate w| in all lanes -> number of lanes that want `_mended`."""
    doublings = 0
    scale = 1.0
    while largest * scale > SERIES_LIMIT:
        doublings += 1
        scale *= 0.5
    for j in range(used):
        along = work[ALONG + j]
        against = work[AGAINST + j]
        rate = against if work[G + j] < 0.0 else along
        part = work[WIDTH + j] * scale
        work[WEAKENED + j] = part * _series(rate * part)
    for _ in range(doublings):  # (1 - e^-2x) / rate = f (2 - rate f), which loses no digits
        for j in range(used):
            along = work[ALONG + j]
            against = work[AGAINST + j]
            rate = against if work[G + j] < 0.0 else along
            work[WEAKENED + j] *= 2.0 - rate * work[WEAKENED + j]
    special = 0
    for j in range(used):
        g = work[G + j]
        along = work[ALONG + j]
        against = work[AGAINST + j]
        rate = against if g < 0.0 else along
        free = relaxed(g, work[DRIVE + j], rate, min(work[WEAKENED + j], HUGE))
        work[OLD + j] = g
        work[G + j] = free
        special += 1 if ((g < 0.0) & (free > 0.0)) | (abs(free) > work[BOUND + j]) else 0
    return special


@njit(cache=True, error_model="numpy")
def _mended(work: Array, used: int) -> None:
    """Repeat the increment for the lanes whose g crossed 0 on it; cut the ones that ran away."""
    for j in range(used):
        if work[OLD + j] < 0.0 and work[G + j] > 0.0:
            along, against = work[ALONG + j], work[AGAINST + j]
            work[G + j] = regrown(work[OLD + j], work[DRIVE + j], along, against, work[WIDTH + j])
        work[G + j] = min(max(work[G + j], -work[BOUND + j]), work[BOUND + j])


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _fine(work, j, g, width):  # type: ignore[no-untyped-def]
    """g of one lane after an increment that is short enough for the series."""
    along = work[ALONG + j]
    against = work[AGAINST + j]
    rate = against if g < 0.0 else along
    return relaxed(g, work[DRIVE + j], rate, width * _series(rate * width))


@njit(inline="always", error_model="numpy")
def _turned(work, j, step):  # type: ignore[no-untyped-def]
    """g = s h of one lane changes sign with s, the direction of the input."""
    mirror = work[MIRROR + j]
    direction = mirror if step >= 0.0 else -mirror
    g = work[G + j] * work[DIRECTION + j]
    work[DIRECTION + j] = direction
    return g * direction


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def bouc_wen(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array) -> Array:
    """Bouc-Wen with n = 1, exact on every increment of the input.

    u : float64[samples, 1] shared by the swarm, or float64[samples, swarm]    input
    alpha : float64[swarm]          height of the loop against the linear response, 1
    beta, gamma : float64[swarm]    shape of the loop, 1 / unit of u, any sign
    d : float64[swarm]              linear response, unit of v / unit of u
    -> float64[samples, swarm]      v = d u - h; finite: see RUNAWAY

    [1] eq. (1)  Ours: h = 0 at the first sample, so v(0) = d u(0).
    """
    samples, columns = u.shape
    swarm = d.size
    length, largest = paths(u)
    v = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        work = np.zeros(ROWS * LANES)
        fastest = 0.0
        widest = 0.0
        rising = True
        for j in range(used):
            column = first + j if columns > 1 else 0
            loop = alpha[first + j] * d[first + j]
            mirror = 1.0 if loop >= 0.0 else -1.0
            work[DRIVE + j] = abs(loop)
            work[ALONG + j] = beta[first + j] + mirror * gamma[first + j]
            work[AGAINST + j] = beta[first + j] - mirror * gamma[first + j]
            work[BOUND + j] = RUNAWAY * abs(loop) * length[column]
            work[SLOPE + j] = d[first + j]
            work[MIRROR + j] = mirror
            work[DIRECTION + j] = mirror
            widest = max(widest, largest[column])
            fastest = max(fastest, max(abs(work[ALONG + j]), abs(work[AGAINST + j])))
            work[INPUT + j] = u[0, column]
            v[0, first + j] = d[first + j] * u[0, column]
        for i in range(1, samples):
            steepest = fastest * (widest if columns > 1 else abs(u[i, 0] - u[i - 1, 0]))
            special = 0
            if columns > 1:
                for j in range(used):
                    x = u[i, first + j]
                    work[WIDTH + j] = x - work[INPUT + j]
                    work[INPUT + j] = x
                if steepest > SERIES_LIMIT:
                    for j in range(used):
                        work[G + j] = _turned(work, j, work[WIDTH + j])
                        work[WIDTH + j] = abs(work[WIDTH + j])
                    special = _coarse(work, used, steepest)
                    for j in range(used):
                        v[i, first + j] = work[SLOPE + j] * work[INPUT + j] - work[DIRECTION + j] * work[G + j]
                else:
                    for j in range(used):
                        g = _turned(work, j, work[WIDTH + j])
                        width = abs(work[WIDTH + j])
                        free = _fine(work, j, g, width)
                        work[WIDTH + j] = width
                        work[OLD + j] = g
                        work[G + j] = free
                        v[i, first + j] = work[SLOPE + j] * work[INPUT + j] - work[DIRECTION + j] * free
                        special += 1 if ((g < 0.0) & (free > 0.0)) | (abs(free) > work[BOUND + j]) else 0
                if special > 0:
                    _mended(work, used)
                    for j in range(used):
                        v[i, first + j] = work[SLOPE + j] * work[INPUT + j] - work[DIRECTION + j] * work[G + j]
                continue

            x = u[i, 0]
            step = x - u[i - 1, 0]
            width = abs(step)
            if (step < 0.0) == rising and step != 0.0:
                rising = not rising
                for j in range(used):
                    work[G + j] = _turned(work, j, step)
            if steepest > SERIES_LIMIT:
                work[WIDTH : WIDTH + used] = width
                special = _coarse(work, used, steepest)
                for j in range(used):
                    v[i, first + j] = work[SLOPE + j] * x - work[DIRECTION + j] * work[G + j]
            else:  # the same in one pass
                for j in range(used):
                    g = work[G + j]
                    free = _fine(work, j, g, width)
                    work[OLD + j] = g
                    work[G + j] = free
                    v[i, first + j] = work[SLOPE + j] * x - work[DIRECTION + j] * free
                    special += 1 if ((g < 0.0) & (free > 0.0)) | (abs(free) > work[BOUND + j]) else 0
            if special > 0:
                work[WIDTH : WIDTH + used] = width
                _mended(work, used)
                for j in range(used):
                    v[i, first + j] = work[SLOPE + j] * x - work[DIRECTION + j] * work[G + j]
    return v

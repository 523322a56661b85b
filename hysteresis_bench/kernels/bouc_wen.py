"""Bouc-Wen hysteresis of a swarm, integrated over increments of the input: rate-independent to rounding.

Time never enters. With w = |du| along an increment, s its direction and g = s h, equation (1) of [1],

    dh/dt = alpha d u' - beta |u'| |h|^(n-1) h - gamma u' |h|^n,

is dg/dw = A - rate |g|^(n-1) g with A = alpha d, and the rate beta + gamma while g > 0, beta - gamma while g < 0.
For n = 1 it is linear and has a closed form up to the one crossing of g = 0 that an increment may have. A
negative A is the same equation with g mirrored and the two rates exchanged: what follows has A >= 0, the
rate `along` where g has the sign that A drives it to, and `against` where it has not.

[1] The PEA paper: a particle swarm genetic hybrid to identify a Hammerstein model, equation (1).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

SERIES_LIMIT = 0.25
"""Largest |rate w| for the series of (1 - exp(-x)) / x below; its first neglected term is 2.4e-14 there."""

STEEPEST = 200.0
"""A rate that would let h grow by more than e^200 within one sample is cut to that. A bounded h never
notices: it has crossed zero, or has settled, long before the sample's end."""

RUNAWAY = 1e9
"""Where h has no bound (beta < 0 or beta + gamma < 0) it is cut at this many times |A| times the length of
the input's path, which a bounded h does not exceed once."""

LANES = 64
"""Particles that are integrated side by side."""

# Rows of one work array: constant offsets tell the compiler that they do not overlap.
G, OLD, WIDTH, WEAKENED, DRIVE, ALONG, AGAINST, BOUND, SLOPE, DIRECTION, RISING = (row * LANES for row in range(11))
ROWS = 11


@njit(cache=True, error_model="numpy", fastmath=True)
def _paths(u: Array) -> tuple[Array, Array]:
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
def _weakened(rate: float, width: float) -> float:
    """(1 - exp(-rate * width)) / rate: an increment as g sees it, weakened by its own relaxation."""
    return width if rate == 0.0 else -math.expm1(-rate * width) / rate


@njit(cache=True, error_model="numpy")
def _regrown(g: float, drive: float, along: float, against: float, width: float) -> float:
    """g after an increment on which it crosses 0 from below: with the rate `against` until then."""
    if drive == 0.0:
        return 0.0
    until = -g / drive if against == 0.0 else math.log1p(-against * g / drive) / against
    return drive * _weakened(along, width - min(max(until, 0.0), width))


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
        free = g + (work[DRIVE + j] - rate * g) * work[WEAKENED + j]
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
            work[G + j] = _regrown(work[OLD + j], work[DRIVE + j], along, against, work[WIDTH + j])
        work[G + j] = min(max(work[G + j], -work[BOUND + j]), work[BOUND + j])


@njit(cache=True, error_model="numpy")
def _turned(work: Array, used: int) -> None:
    """Reversal of the input of the lanes whose increment (in WIDTH, with its sign) and RISING disagree:
    g = s h changes sign with s."""
    for j in range(used):
        if work[WIDTH + j] * work[RISING + j] < 0.0:
            work[RISING + j] = -work[RISING + j]
            work[G + j] = -work[G + j]
            work[DIRECTION + j] = -work[DIRECTION + j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def bouc_wen(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array) -> Array:
    """Bouc-Wen with n = 1, exact on every increment of the input.

    u : float64[samples, 1] shared by the swarm, or float64[samples, swarm]    input
    alpha : float64[swarm]          height of the loop against the linear response, 1
    beta, gamma : float64[swarm]    shape of the loop, 1 / unit of u, any sign
    d : float64[swarm]              linear response, unit of v / unit of u
    -> float64[samples, swarm]      v = d u - h; finite: see STEEPEST and RUNAWAY

    [1] eq. (1)  Ours: h = 0 at the first sample, so v(0) = d u(0).
    """
    samples, columns = u.shape
    swarm = d.size
    length, largest = _paths(u)
    v = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        work = np.zeros(ROWS * LANES)
        fastest = 0.0
        widest = 0.0
        for j in range(used):
            column = first + j if columns > 1 else 0
            loop = alpha[first + j] * d[first + j]
            mirror = 1.0 if loop >= 0.0 else -1.0
            floor = -STEEPEST / max(largest[column], 1e-300)
            work[DRIVE + j] = abs(loop)
            work[ALONG + j] = max(beta[first + j] + mirror * gamma[first + j], floor)
            work[AGAINST + j] = max(beta[first + j] - mirror * gamma[first + j], floor)
            work[BOUND + j] = RUNAWAY * abs(loop) * length[column]
            work[SLOPE + j] = d[first + j]
            work[DIRECTION + j] = mirror
            work[RISING + j] = 1.0
            widest = max(widest, largest[column])
            fastest = max(fastest, max(abs(work[ALONG + j]), abs(work[AGAINST + j])))
            v[0, first + j] = d[first + j] * u[0, column]
        for i in range(1, samples):
            turned = 0
            if columns > 1:
                for j in range(used):
                    step = u[i, first + j] - u[i - 1, first + j]
                    work[WIDTH + j] = step
                    turned += 1 if step * work[RISING + j] < 0.0 else 0
                if turned > 0:
                    _turned(work, used)
                for j in range(used):
                    work[WIDTH + j] = abs(work[WIDTH + j])
                if _coarse(work, used, fastest * widest) > 0:
                    _mended(work, used)
                for j in range(used):
                    v[i, first + j] = work[SLOPE + j] * u[i, first + j] - work[DIRECTION + j] * work[G + j]
                continue

            x = u[i, 0]
            step = x - u[i - 1, 0]
            width = abs(step)
            if step * work[RISING] < 0.0:
                work[WIDTH : WIDTH + used] = step
                _turned(work, used)
            special = 0
            if fastest * width > SERIES_LIMIT:
                work[WIDTH : WIDTH + used] = width
                special = _coarse(work, used, fastest * width)
                for j in range(used):
                    v[i, first + j] = work[SLOPE + j] * x - work[DIRECTION + j] * work[G + j]
            else:  # finely sampled data: the same in one pass
                for j in range(used):
                    g = work[G + j]
                    along = work[ALONG + j]
                    against = work[AGAINST + j]
                    rate = against if g < 0.0 else along
                    free = g + (work[DRIVE + j] - rate * g) * (width * _series(rate * width))
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


@njit(cache=True, error_model="numpy")
def _slope(g: float, drive: float, along: float, against: float, n: float) -> float:
    """dg/dw for any n: drive - rate |g|^(n-1) g."""
    return drive - along * g**n if g >= 0.0 else drive + against * (-g) ** n


@njit(cache=True, error_model="numpy")
def _integrated(g: float, drive: float, along: float, against: float, n: float, width: float, bound: float) -> float:
    """g after an increment for any n >= 1: Dormand and Prince's 5(4) pair with adaptive steps."""
    tolerance = 1e-11 * (abs(g) + drive * width)
    done = 0.0
    step = width
    while done < width:
        step = min(step, width - done)
        k1 = _slope(g, drive, along, against, n)
        k2 = _slope(g + step * k1 / 5, drive, along, against, n)
        k3 = _slope(g + step * (3 * k1 / 40 + 9 * k2 / 40), drive, along, against, n)
        k4 = _slope(g + step * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9), drive, along, against, n)
        k5 = _slope(
            g + step * (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 - 212 * k4 / 729),
            drive, along, against, n,
        )  # fmt: skip
        k6 = _slope(
            g + step * (9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247 + 49 * k4 / 176 - 5103 * k5 / 18656),
            drive, along, against, n,
        )  # fmt: skip
        new = g + step * (35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84)
        k7 = _slope(new, drive, along, against, n)
        error = abs(
            step * (71 * k1 / 57600 - 71 * k3 / 16695 + 71 * k4 / 1920 - 17253 * k5 / 339200 + 22 * k6 / 525 - k7 / 40)
        )
        if error <= tolerance:
            done += step
            g = new
        elif step < 1e-12 * width:  # a pole: h runs away within this increment
            return math.copysign(bound, g)
        if abs(g) >= bound:
            return math.copysign(bound, g)
        # NaN, from a trial step beyond a pole, fails the comparison and shrinks the step most
        growth = 0.9 * (tolerance / max(error, 1e-300)) ** 0.2 if error < np.inf else 0.2
        step *= min(max(growth, 0.2), 5.0)
    return g


@njit(cache=True, error_model="numpy")
def bouc_wen_power(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array, n: float) -> Array:
    """Bouc-Wen with any n >= 1, integrated adaptively in u to a relative error of 1e-8 or better.

    n : smoothness of the loop, 1; the other arguments, and the result, as in `bouc_wen`

    [1] eq. (1)  Ours: h = 0 at the first sample; the cut RUNAWAY, which also ends a pole.
    """
    samples, columns = u.shape
    swarm = d.size
    length, _ = _paths(u)
    v = np.empty((samples, swarm))
    for j in range(swarm):
        column = j if columns > 1 else 0
        loop = alpha[j] * d[j]
        drive = abs(loop)
        mirror = 1.0 if loop >= 0.0 else -1.0
        along, against = beta[j] + mirror * gamma[j], beta[j] - mirror * gamma[j]
        bound = RUNAWAY * drive * length[column]
        h = 0.0
        v[0, j] = d[j] * u[0, column]
        for i in range(1, samples):
            step = u[i, column] - u[i - 1, column]
            if step != 0.0 and drive > 0.0:
                sign = mirror if step > 0.0 else -mirror
                h = sign * _integrated(sign * h, drive, along, against, n, abs(step), bound)
            v[i, j] = d[j] * u[i, column] - h
    return v

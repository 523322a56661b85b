"""Bouc-Wen hysteresis of a swarm with any smoothness n > 1: `bouc_wen_step` has the law and its step for one particle.

That step chooses its length for itself, which keeps a loop over a swarm from being vectorised. Here all particles make
one Taylor step of fifth order an increment of the input, side by side, or several of equal length where the increments
are coarse; the last term is the estimate of the error. The step of `bouc_wen_step` is made only for the particles
whose h crosses 0 and for those few whose error is too large: 12 to 110 times as fast for finely sampled data.

With a = |g| and the derivatives in g of f = A - rate |g|^(n-1) g written D, E, F, G,

    g'' = D f,   g''' = E f^2 + D^2 f,   g'''' = (F f^2 + 4 D E f + D^3) f,
    g''''' = (G f^3 + (7 D F + 4 E^2) f^2 + 11 D^2 E f + D^4) f.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import FEW as FEW_LANES
from hysteresis_bench.kernels.bouc_wen import FULL, paths
from hysteresis_bench.kernels.bouc_wen_step import RUNAWAY, integrated
from hysteresis_bench.kernels.elementary import exponential, logarithm

TOLERANCE = 1e-8
"""Largest last term of the series as a share of A w; what the result is off by is a hundredth of it or less."""

MOST_STEPS = 32
"""Steps an increment; particles that want more are left to the step for one particle."""

FEW = 8
"""One particle in so many may be left to the step for one particle before all make shorter steps."""

TINY = 1e-60

LANES = 64
"""Particles that are integrated side by side."""

# Rows of one work array: constant offsets tell the compiler that they do not overlap.
H, G, OLD, WIDTH, SIGN, SPECIAL, DRIVE, ALONG = (row * LANES for row in range(8))
AGAINST, BOUND, SLOPE, MIRROR, INPUT, POWER, OUT = (row * LANES for row in range(8, 15))
ROWS = 15


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _advanced(g, power, drive, along, against, n, whole, width):  # type: ignore[no-untyped-def]
    """g after a step, its slope before, and the size of the last term.

    power : |g|^(n - 1), where `whole` is 0;  whole : n where it is 2 or 3, else 0; a constant
    """
    size = abs(g)
    rate = against if g < 0.0 else along
    signed = rate * math.copysign(1.0, g)
    if whole == 2:
        p1, p2, p3, p4 = size, 1.0, 0.0, 0.0
    elif whole == 3:
        p1, p2, p3, p4 = size * size, size, 1.0, 0.0
    else:
        p1 = power
        inverse = 1.0 / max(size, TINY)
        p2 = p1 * inverse
        p3 = p2 * inverse
        p4 = p3 * inverse
    f = drive - rate * g * p1
    d = -n * rate * p1
    e = -n * (n - 1.0) * signed * p2
    dd = d * d
    third = e * f + dd
    if whole == 2:
        fourth = d * (4.0 * e * f + dd)
        fifth = f * e * (4.0 * e * f + 11.0 * dd) + dd * dd
    else:
        ff = -n * (n - 1.0) * (n - 2.0) * rate * p3
        gg = -n * (n - 1.0) * (n - 2.0) * (n - 3.0) * signed * p4 if whole == 0 else 0.0
        fourth = f * (ff * f + 4.0 * d * e) + dd * d
        fifth = f * (f * (gg * f + 7.0 * d * ff + 4.0 * e * e) + 11.0 * dd * e) + dd * dd
    rise = f * width
    last = fifth * rise * ((width * width) * (width * width) * (1.0 / 120.0))
    series = 1.0 + width * (d * (1.0 / 2.0) + width * (third * (1.0 / 6.0) + width * (fourth * (1.0 / 24.0))))
    return g + (rise * series + last), f, abs(last)


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _powers(work, used, n, whole, row):  # type: ignore[no-untyped-def]
    """|g|^(n - 1) of all lanes, g in this row; a loop of its own, else the others would not be vectorised."""
    if whole == 0:
        for j in range(used):
            work[POWER + j] = exponential((n - 1.0) * logarithm(abs(work[row + j])))


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _stepped(work, j, g, width, n, whole):  # type: ignore[no-untyped-def]
    """g of one lane after a step, and whether that is right."""
    drive = work[DRIVE + j]
    along = work[ALONG + j]
    against = work[AGAINST + j]
    bound = work[BOUND + j]
    free, f, last = _advanced(g, work[POWER + j], drive, along, against, n, whole, width)
    smooth = (g > TINY) | ((g < -TINY) & (free <= 0.0))  # else it crosses 0, or leaves it
    right = smooth & (last <= TOLERANCE * drive * width) & (abs(free) < bound)
    held = (abs(g) >= bound) & (f * g >= 0.0)  # driven beyond the bound

    return g if held else free, right | held


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _at_once(work, j, x, step, n, whole):  # type: ignore[no-untyped-def]
    """One lane on to the input x by one step -> 1 where that is not right, which SPECIAL marks."""
    mirror = work[MIRROR + j]
    sign = mirror if step >= 0.0 else -mirror
    g = sign * work[H + j]
    new, right = _stepped(work, j, g, abs(step), n, whole)
    work[WIDTH + j] = abs(step)
    work[INPUT + j] = x
    work[SIGN + j] = sign
    work[OLD + j] = g
    work[G + j] = new
    work[H + j] = sign * new
    work[SPECIAL + j] = 0.0 if right else 1.0
    work[OUT + j] = work[SLOPE + j] * x - sign * new
    return 0 if right else 1


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _in_steps(work, used, n, whole, steps):  # type: ignore[no-untyped-def]
    """All lanes from OLD to G in so many steps."""
    share = 1.0 / steps
    work[G : G + used] = work[OLD : OLD + used]
    work[SPECIAL : SPECIAL + used] = 0.0
    for _ in range(steps):
        _powers(work, used, n, whole, G)
        for j in range(used):
            before = work[SPECIAL + j]
            new, right = _stepped(work, j, work[G + j], work[WIDTH + j] * share, n, whole)
            work[G + j] = new
            work[SPECIAL + j] = before if right else 1.0


@njit(inline="always", error_model="numpy")
def _count(work, used):  # type: ignore[no-untyped-def]
    """How many lanes are marked SPECIAL."""
    special = 0
    for j in range(used):
        special += 1 if work[SPECIAL + j] > 0.0 else 0
    return special


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _simulated(u, alpha, beta, gamma, d, n, whole):  # type: ignore[no-untyped-def]
    samples, columns = u.shape
    swarm = d.size
    length, _ = paths(u)
    v = np.empty((samples, swarm))
    flat, inputs, shared = v.reshape(samples * swarm), u.ravel(), columns == 1
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        full = -(-used // FULL) * FULL if whole > 0 and used > FEW_LANES else used
        work = np.zeros(ROWS * LANES)
        for j in range(used):
            column = 0 if shared else first + j
            loop = alpha[first + j] * d[first + j]
            mirror = 1.0 if loop >= 0.0 else -1.0
            work[DRIVE + j] = abs(loop)
            work[ALONG + j] = beta[first + j] + mirror * gamma[first + j]
            work[AGAINST + j] = beta[first + j] - mirror * gamma[first + j]
            work[BOUND + j] = RUNAWAY * abs(loop) * length[column]
            work[SLOPE + j] = d[first + j]
            work[MIRROR + j] = mirror
            work[INPUT + j] = u[0, column]
            v[0, first + j] = d[first + j] * u[0, column]
        steps = 1
        for i in range(1, samples):
            out = flat[i * swarm + first : i * swarm + first + used]
            special = 0
            _powers(work, full, n, whole, H)
            if shared:
                x = u[i, 0]
                step = x - u[i - 1, 0]
                for j in range(full):
                    special += _at_once(work, j, x, step, n, whole)
            else:
                row = inputs[i * swarm + first : i * swarm + first + used]
                for j in range(used):
                    special += _at_once(work, j, row[j], row[j] - work[INPUT + j], n, whole)
            for j in range(used):
                out[j] = work[OUT + j]
            if special == 0:
                continue
            steps = max(steps // 2, 2)
            while special * FEW > used and steps <= MOST_STEPS:
                _in_steps(work, used, n, whole, steps)
                special = _count(work, used)
                steps *= 2
            for j in range(used):
                if work[SPECIAL + j] > 0.0:
                    drive, along, against = work[DRIVE + j], work[ALONG + j], work[AGAINST + j]
                    work[G + j] = integrated(work[OLD + j], drive, along, against, n, work[WIDTH + j], work[BOUND + j])
                work[H + j] = work[SIGN + j] * work[G + j]
                out[j] = work[SLOPE + j] * work[INPUT + j] - work[H + j]
    return v


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _squared(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array) -> Any:
    return _simulated(u, alpha, beta, gamma, d, 2.0, 2)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _cubed(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array) -> Any:
    return _simulated(u, alpha, beta, gamma, d, 3.0, 3)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _any(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array, n: float) -> Any:
    return _simulated(u, alpha, beta, gamma, d, n, 0)


def bouc_wen_power(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array, n: float) -> Array:
    """Bouc-Wen with any n > 1, to a relative error of 1e-9; of 1e-8 where n is not whole.

    n : smoothness of the loop, 1; the other arguments, and the result, as in `bouc_wen`

    [1] eq. (1)  Ours: h = 0 at the first sample; the cut RUNAWAY, which also ends a pole.
    """
    if n == 2.0:
        simulated: Array = _squared(u, alpha, beta, gamma, d)
    elif n == 3.0:
        simulated = _cubed(u, alpha, beta, gamma, d)
    else:
        simulated = _any(u, alpha, beta, gamma, d, n)
    return simulated

"""One increment of Bouc-Wen hysteresis for one particle: the step that every Bouc-Wen kernel makes.

Time never enters. With w = |du| along an increment, s its direction and g = s h, equation (1) of [1],

    dh/dt = alpha d u' - beta |u'| |h|^(n-1) h - gamma u' |h|^n,

is dg/dw = A - rate |g|^(n-1) g with A = alpha d, and the rate beta + gamma while g > 0, beta - gamma while g < 0.
For n = 1 it is linear and has a closed form up to the one crossing of g = 0 that an increment may have. A
negative A is the same equation with g mirrored and the two rates exchanged: what follows has A >= 0, called the
drive, the rate `along` where g has the sign that A drives it to, and `against` where it has not.

[1] The PEA paper: a particle swarm genetic hybrid to identify a Hammerstein model, equation (1).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

RUNAWAY = 1e9
"""Where h has no bound (beta < 0 or beta + gamma < 0) it is cut at this many times |A| times the length of
the input's path, which a bounded h does not exceed once."""

HUGE = 1e300
"""A growth e^(-rate w) that overflows is cut here, so that infinity times 0 does not arise. A bounded h does not
notice: it has crossed 0 long before the end of the increment, and the crossing is computed from its start."""


@njit(cache=True, error_model="numpy")
def weakened(rate: float, width: float) -> float:
    """(1 - exp(-rate * width)) / rate: an increment as g sees it, weakened by its own relaxation."""
    return width if rate == 0.0 else min(-math.expm1(-rate * width) / rate, HUGE)


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def relaxed(g, drive, rate, seen):  # type: ignore[no-untyped-def]
    """g after an increment on which its rate does not change; seen : `weakened(rate, width)`."""
    return g + (drive - rate * g) * seen


@njit(cache=True, error_model="numpy")
def regrown(g: float, drive: float, along: float, against: float, width: float) -> float:
    """g after an increment on which it crosses 0 from below: with the rate `against` until then."""
    if drive == 0.0:
        return 0.0
    until = -g / drive if against == 0.0 else math.log1p(-against * g / drive) / against
    return drive * weakened(along, width - min(max(until, 0.0), width))


@njit(cache=True, error_model="numpy")
def slope(g: float, drive: float, along: float, against: float, n: float) -> float:
    """dg/dw for any n: drive - rate |g|^(n-1) g."""
    return drive - along * g**n if g >= 0.0 else drive + against * (-g) ** n


@njit(cache=True, error_model="numpy")
def integrated(g: float, drive: float, along: float, against: float, n: float, width: float, bound: float) -> float:
    """g after an increment for any n >= 1: Dormand and Prince's 5(4) pair with adaptive steps."""
    tolerance = 1e-11 * (abs(g) + drive * width)
    done = 0.0
    step = width
    while done < width:
        step = min(step, width - done)
        k1 = slope(g, drive, along, against, n)
        k2 = slope(g + step * k1 / 5, drive, along, against, n)
        k3 = slope(g + step * (3 * k1 / 40 + 9 * k2 / 40), drive, along, against, n)
        k4 = slope(g + step * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9), drive, along, against, n)
        k5 = slope(
            g + step * (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 - 212 * k4 / 729),
            drive, along, against, n,
        )  # fmt: skip
        k6 = slope(
            g + step * (9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247 + 49 * k4 / 176 - 5103 * k5 / 18656),
            drive, along, against, n,
        )  # fmt: skip
        new = g + step * (35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84)
        k7 = slope(new, drive, along, against, n)
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
def grown(g: float, drive: float, along: float, against: float, n: float, width: float, bound: float) -> float:
    """g after an increment of this width >= 0, |g| cut at `bound`: exact for n = 1, adaptive for n > 1."""
    if width == 0.0:
        return g
    if n != 1.0:
        return integrated(g, drive, along, against, n, width, bound)
    rate = against if g < 0.0 else along
    free = relaxed(g, drive, rate, weakened(rate, width))
    if g < 0.0 and free > 0.0:
        free = regrown(g, drive, along, against, width)
    return min(max(free, -bound), bound)


@njit(cache=True, error_model="numpy")
def moved(h: float, step: float, loop: float, beta: float, gamma: float, n: float, bound: float) -> float:
    """h after the input has gone on by `step`, |h| cut at `bound`; loop = alpha d, any sign."""
    mirror = 1.0 if loop >= 0.0 else -1.0
    sign = mirror if step >= 0.0 else -mirror
    return sign * grown(sign * h, abs(loop), beta + mirror * gamma, beta - mirror * gamma, n, abs(step), bound)

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


NEAR = 0.25
"""Share of the drive, rate |g|^n over drive, up to which g is followed by a series in it."""

SURELY = 0.89
"""g takes at least this share of size / drive to a size where its rate is at most NEAR, as the series says."""

SMALL = 1e-4
"""The same share, up to which the first terms of the series in it and of its inverse are enough: the next is 1e-13."""

FAR = 1e8
"""The same share, from which on the drive is left out: h runs away, or comes back from there."""

LEAST_DRIVE = 1e-250
"""Below it the drive counts as 0: powers of what it makes underflow, and no step is small enough for the tolerance."""


@njit(cache=True, error_model="numpy")
def weakened(rate: float, width: float) -> float:
    """(1 - exp(-rate * width)) / rate: an increment as g sees it, weakened by its own relaxation."""
    return width if rate == 0.0 else min(-math.expm1(-rate * width) / rate, HUGE)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
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
def _width_from_0(size: float, share: float, drive: float, n: float) -> float:
    """The increment that takes g from 0 to this size: the integral of dg / (drive - rate g^n), as a series.

    share : rate size^n / drive, at most NEAR
    """
    total, power, k = 1.0, 1.0, 1.0
    while abs(power) > 1e-17:
        power *= share
        total += power / (k * n + 1.0)
        k += 1.0
    return size / drive * total


@njit(cache=True, error_model="numpy")
def _size_from_0(width: float, drive: float, rate: float, n: float, edge: float) -> float:
    """The size of g after an increment from 0, at most `edge`: Newton's method on `_width_from_0`."""
    size = min(drive * width, edge)
    for _ in range(20):
        share = rate * size**n / drive
        change = (_width_from_0(size, share, drive, n) - width) * drive * (1.0 - share)
        size = min(max(size - change, 0.0), edge)
        if abs(change) <= 1e-15 * size:
            break
    return size


@njit(cache=True, error_model="numpy")
def integrated(g: float, drive: float, along: float, against: float, n: float, width: float, bound: float) -> float:
    """g after an increment for any n >= 1: by a series near g = 0, where the rate jumps and |g|^n may not be smooth,
    by Dormand and Prince's 5(4) pair with adaptive steps elsewhere; to a relative error of about 1e-11."""
    left = width
    step = width
    if drive < LEAST_DRIVE:
        drive = 0.0
    while left > 0.0:
        k1 = slope(g, drive, along, against, n)
        if abs(g) >= bound and k1 * g >= 0.0:
            return math.copysign(bound, g)
        if abs(k1 - drive) > FAR * drive:
            rate = along if g > 0.0 else against
            ahead = abs(g) ** (1.0 - n) + (n - 1.0) * rate * left  # |g|^(1 - n), but for the drive
            if rate < 0.0:
                return math.copysign(ahead ** (1.0 / (1.0 - n)) if ahead > bound ** (1.0 - n) else bound, g)
            edge = (FAR * drive / rate) ** (1.0 / n)
            if ahead <= edge ** (1.0 - n):
                return math.copysign(ahead ** (1.0 / (1.0 - n)), g)
            left = (ahead - edge ** (1.0 - n)) / ((n - 1.0) * rate)
            g = math.copysign(edge, g)
            k1 = slope(g, drive, along, against, n)
        if abs(g) < 2.0 * drive * left and abs(k1 - drive) <= NEAR * drive:
            since = _width_from_0(abs(g), 1.0 - k1 / drive, drive, n)
            if g < 0.0 and since >= left:
                return -_size_from_0(since - left, drive, -against, n, -g)
            left += since if g > 0.0 else -since
            edge = (NEAR * drive / abs(along)) ** (1.0 / n) if along != 0.0 else np.inf
            near = left * drive <= SURELY * edge
            whole = left if near else _width_from_0(edge, math.copysign(NEAR, along), drive, n)
            if left <= whole:
                return min(_size_from_0(left, drive, along, n, edge), bound)
            g = edge
            left -= whole
            k1 = slope(g, drive, along, against, n)
        step = min(step, left)
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
        if g < 0.0 and new > 0.0:  # to the edge of the series first
            step *= 0.5
            continue
        tolerance = 1e-11 * (abs(g) + drive * width)
        if error <= tolerance:
            left -= step
            g = new
        elif step < 1e-12 * width:  # a pole: h runs away within this increment
            return math.copysign(bound, g)
        # NaN, from a trial step beyond a pole, fails the comparison and shrinks the step most
        growth = 0.9 * (tolerance / max(error, 1e-300)) ** 0.2 if error < np.inf else 0.2
        step *= min(max(growth, 0.2), 5.0)
    return g


@njit(cache=True, error_model="numpy")
def _to_the(size: float, n: float) -> float:
    """size^n, faster where n is 2 or 3."""
    if n == 2.0:
        return size * size
    return size * size * size if n == 3.0 else size**n


@njit(cache=True, error_model="numpy")
def _through_0(g: float, drive: float, along: float, against: float, n: float, width: float) -> float:
    """g after an increment that takes it through 0, by the first terms of the series; -1 where they are not enough."""
    share = -against * _to_the(-g, n) / drive
    since = -g / drive * (1.0 + share * (1.0 / (n + 1.0) + share / (2.0 * n + 1.0)))
    straight = drive * (width - since)
    if not (abs(share) <= SMALL and straight >= 0.0):
        return -1.0
    share = along * _to_the(straight, n) / drive
    found = straight * (1.0 - share / (n + 1.0) * (1.0 - share * n / (2.0 * n + 1.0)))
    return found if abs(share) <= SMALL else -1.0


@njit(cache=True, error_model="numpy")
def grown(g: float, drive: float, along: float, against: float, n: float, width: float, bound: float) -> float:
    """g after an increment of this width >= 0, |g| cut at `bound`: exact for n = 1, adaptive for n > 1."""
    if width == 0.0:
        return g
    if n != 1.0:
        if g <= 0.0 < drive:
            through = _through_0(g, drive, along, against, n, width)
            if 0.0 <= through <= bound:
                return through
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

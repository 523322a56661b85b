"""Bouc-Wen hysteresis of a swarm with any smoothness n > 1: `bouc_wen_step` has the law and its step for one particle.

That step chooses its length for itself, which keeps a loop over a swarm from being vectorised. Here all particles make
one step an increment of the input, side by side, or several of equal length where the increments are coarse. The step
of `bouc_wen_step` is made only for the particles whose h crosses 0 and for those few that want shorter ones still.

With w the increment and f = A - rate |h|^(n-1) h, the step is for n = 2, where rate' has the sign of h, exact [1]:

    h + f T / (1 + rate' h T),   T = w tanh(z) / z,   z^2 = A rate' w^2,

and a Taylor step of fifth order for every other n, the last term of which is the estimate of the error. With the
derivatives in h of f written D, E, F, G,

    h'' = D f,   h''' = E f^2 + D^2 f,   h'''' = (F f^2 + 4 D E f + D^3) f,
    h''''' = (G f^3 + (7 D F + 4 E^2) f^2 + 11 D^2 E f + D^4) f.

[1] W. T. Reid, Riccati Differential Equations, Academic Press (1972), ch. I.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import (
    DRIVE,
    FALLING,
    FEW,
    FULL,
    INPUT,
    LANES,
    OLD,
    RISING,
    ROWS,
    SLOPE,
    STEP,
    H,
    mended,
    outside,
    paths,
    prepared,
)
from hysteresis_bench.kernels.elementary import exponential, logarithm

TOLERANCE, TOLERANCE_ANY = 1.5e-8, 2e-9
"""Largest last term of the series as a share of A w, n = 3 and any n; what the result is off by is a hundredth of it
or less on finely sampled data."""

LEFT_OUT = 28 / 3
"""Largest q^2 over the tolerance, of a step from 0 with n = 3: h = A w (1 - q/4 + 3 q^2/28 - ...), q = rate A^2 w^3."""

FRACTION_LIMIT = 0.3
"""Largest |z^2| for the continued fraction of tanh(z) / z below; it is off by 1e-15 there."""

MOST_STEPS = 32
"""Steps an increment; particles that want more are left to the step for one particle."""

LONGER, LONGER_ANY = 250, 15
"""So many times longer takes the step for one particle than one of those side by side, n whole and n not whole."""

TINY = 1e-60

POWER = np.uint64(ROWS * LANES)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _squared_step(h, drive, rate, step):  # type: ignore[no-untyped-def]
    rise, decay = drive * step, rate * step
    z2, bend = rise * decay, decay * h
    top = 1.0 + z2 * (5 / 39 + z2 * (2 / 715 + z2 * (1 / 135135)))
    bottom = 1.0 + z2 * (6 / 13 + z2 * (10 / 429 + z2 * (4 / 19305)))
    new = h + (rise - bend * h) * top / (bottom + bend * top)
    return new if abs(z2) <= FRACTION_LIMIT else np.nan


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _cubed_step(h, drive, rate, step):  # type: ignore[no-untyped-def]
    """The series with all its factors multiplied out."""
    rise, decay = drive * step, rate * step
    bend = decay * h
    c = bend * h
    first = rise - c * h
    e, q, c2 = bend * first, decay * first * first, c * c
    series = ((1.0 - 1.5 * c) + c2 * (1.5 - 1.125 * c)) + (e * (3.0 * c - 1.0) - 0.25 * q)
    last = (first * c) * ((2.25 * q + 0.675 * (c2 * c)) - 4.95 * (c * e))
    new = h + (first * series + last)
    # near 0 the last term vanishes with h, and the one of seventh order, 3/28 q^2, is what is left out
    return new if (abs(last) <= TOLERANCE * abs(rise)) & (q * q <= LEFT_OUT * TOLERANCE) else np.nan


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _power_step(h, power, drive, rate, step, n):  # type: ignore[no-untyped-def]
    """power : |h|^(n - 1)"""
    size = abs(h)
    inverse = 1.0 / (size if size > TINY else TINY)
    signed = rate * math.copysign(1.0, h)
    p2 = power * inverse
    p3 = p2 * inverse
    f = drive - rate * h * power
    d = -n * rate * power
    e = -n * (n - 1.0) * signed * p2
    ff = -n * (n - 1.0) * (n - 2.0) * rate * p3
    gg = -n * (n - 1.0) * (n - 2.0) * (n - 3.0) * signed * (p3 * inverse)
    dd = d * d
    third = e * f + dd
    fourth = f * (ff * f + 4.0 * d * e) + dd * d
    fifth = f * (f * (gg * f + 7.0 * d * ff + 4.0 * e * e) + 11.0 * dd * e) + dd * dd
    rise = f * step
    last = fifth * rise * ((step * step) * (step * step) * (1.0 / 120.0))
    series = 1.0 + step * (d * (1.0 / 2.0) + step * (third * (1.0 / 6.0) + step * (fourth * (1.0 / 24.0))))
    new = h + (rise * series + last)
    # a series about h says little of what is further from it than 0 is
    near = abs(drive * step) <= size
    return new if (abs(last) <= TOLERANCE_ANY * abs(drive * step)) & near else np.nan


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(work, j, rate, step, n, whole):  # type: ignore[no-untyped-def]
    """h of one lane after a step, NaN where that is too long;  whole : n where it is 2 or 3, else 0; a constant"""
    h, drive = work[H + j], work[DRIVE + j]
    if whole == 2:
        new = _squared_step(h, drive, rate, step)
    elif whole == 3:
        new = _cubed_step(h, drive, rate, step)
    else:
        new = _power_step(h, work[POWER + j], drive, rate, step, n)
    work[H + j] = new


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _powers(work, lanes, n, whole):  # type: ignore[no-untyped-def]
    """|h|^(n - 1) of all lanes; a loop of its own, else the others would not be vectorised."""
    if whole == 0:
        for j in range(lanes):
            work[POWER + j] = exponential((n - 1.0) * logarithm(abs(work[H + j])))


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _in_steps(work, lanes, n, whole, steps):  # type: ignore[no-untyped-def]
    """All lanes from OLD on in so many steps; those that want `mended` are NaN."""
    share = 1.0 / steps
    for j in range(lanes):
        work[H + j] = work[OLD + j]
    for _ in range(steps):
        _powers(work, lanes, n, whole)
        for j in range(lanes):
            rising, falling, step = work[RISING + j], work[FALLING + j], work[STEP + j]
            _advanced(work, j, rising if step >= 0.0 else falling, share * step, n, whole)
            new = work[H + j]
            work[H + j] = np.nan if outside(work, j) else new


@njit(forceinline=True, error_model="numpy")
def _lost(work, lanes):  # type: ignore[no-untyped-def]
    """How many lanes are NaN."""
    lost = 0
    for j in range(lanes):
        lost += 1 if work[H + j] != work[H + j] else 0
    return lost


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _simulated(u, alpha, beta, gamma, d, n, whole):  # type: ignore[no-untyped-def]
    samples, swarm = u.shape[0], d.size
    shared = u.shape[1] == 1
    lengths, p = paths(u), (alpha, beta, gamma, d)
    longer = LONGER if whole > 0 else LONGER_ANY
    v = np.empty((samples, swarm))
    inputs, outputs = u.ravel(), v.reshape(samples * swarm)
    for first in range((swarm - 1) // LANES * LANES, -1, -LANES):  # the last ones first, for their padding
        used = min(LANES, swarm - first)
        full = -(-used // FULL) * FULL if used > FEW else used
        work = np.zeros((ROWS + 1) * LANES)
        for k in range(first, first + used):
            x, length = (u[0, 0], lengths[0]) if shared else (u[0, k], lengths[k])
            prepared(work, np.uint64(k - first), p, k, (x, length, n))
            v[0, k] = d[k] * x
        steps = 1
        for i in range(1, samples):
            lanes = np.uint64(full if i + 1 < samples else used)
            row = np.uint64(i * swarm + first)
            special = 0
            _powers(work, lanes, n, whole)
            if shared:
                x = u[i, 0]
                step = x - u[i - 1, 0]
                if step >= 0.0:
                    for j in range(lanes):
                        work[OLD + j] = work[H + j]
                        _advanced(work, j, work[RISING + j], step, n, whole)
                        outputs[row + j] = work[SLOPE + j] * x - work[H + j]
                        special += 1 if outside(work, j) else 0
                else:
                    for j in range(lanes):
                        work[OLD + j] = work[H + j]
                        _advanced(work, j, work[FALLING + j], step, n, whole)
                        outputs[row + j] = work[SLOPE + j] * x - work[H + j]
                        special += 1 if outside(work, j) else 0
                if special > 0:
                    work[INPUT : INPUT + lanes] = x
                    work[STEP : STEP + lanes] = step
            else:
                for j in range(lanes):
                    now, rising, falling = inputs[row + j], work[RISING + j], work[FALLING + j]
                    step = now - work[INPUT + j]
                    work[OLD + j] = work[H + j]
                    work[STEP + j] = step
                    work[INPUT + j] = now
                    _advanced(work, j, rising if step >= 0.0 else falling, step, n, whole)
                    outputs[row + j] = work[SLOPE + j] * now - work[H + j]
                    special += 1 if outside(work, j) else 0
            if special == 0:
                continue
            steps = max(steps // 2, 2)
            while _lost(work, lanes) * longer > steps * lanes and steps <= MOST_STEPS:
                _in_steps(work, lanes, n, whole, steps)
                steps *= 2
            mended(work, lanes, n)
            for j in range(lanes):
                outputs[row + j] = work[SLOPE + j] * work[INPUT + j] - work[H + j]
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

"""A lag that is a curve of the rate, of a swarm: exact for a signal that is linear between its samples.

What follows a signal u is behind it by d = u - v, and moves at the rate dv/dt = r at which d = g(r): g rises through
the origin in straight pieces, with one slope (a time constant) up to a rate of R and another one beyond, for movement
upwards and downwards each. Over a step of duration h on which u changes by s h,

    dd/dt = s - g⁻¹(d),

so that d goes monotonically towards g(s) and passes from piece to piece on the way; within a piece of slope tau whose
line leads to d_s at the rate s, with x = h / tau,

    d  ->  exp(-x) d  +  d_s (1 - exp(-x)).

With all slopes equal it is the first-order lag of `lag`, with all of them 0 the signal itself, to the last bit.

Columns move side by side as long as each stays within a piece for a whole step, which is most of the time; one that
passes into another piece on the way is moved again by itself.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, taken_in
from hysteresis_bench.kernels.elementary import exponential, exponential_less_1
from hysteresis_bench.kernels.lanes import LANES
from hysteresis_bench.kernels.linear_stage import SAME_STEP

PIECES = 4
"""Fast and slow movement downwards, slow and fast movement upwards: the order of d."""

LEAST = 1e-9
"""Of the step, the shortest time constant: beside pieces that lag, one of less counts as this and leaves no trace."""

# Rows of a group: the signal before and after the step and its slope, what follows, the distance behind before and
# after the step, whether the latter lies in another piece; R and the time constants given; then, of a step of one
# duration, the time constants used, exp(-x), how far d moves for every s and where s is 0, and the ends of the outer
# pieces.
BEFORE, NOW, SLOPE, V, LAST, D, PASSED, KNOT, GIVEN = (row * LANES for row in range(9))
TAU, KEPT, RATED, ALWAYS = (GIVEN + PIECES * LANES * block for block in range(1, 5))
FALLING_END, RISING_END = ALWAYS + PIECES * LANES, ALWAYS + (PIECES + 1) * LANES
ROWS = RISING_END // LANES + 1


@njit(cache=True, error_model="numpy")
def _prepared(s: Array, step: float) -> None:
    """What a step of this duration does, of a group."""
    for j in range(min(LANES, s.size & -LANES)):
        for k in range(PIECES):
            row = k * LANES + j
            tau = max(s[GIVEN + row], LEAST * step)
            s[TAU + row], s[KEPT + row] = tau, exponential(-step / tau)
            s[RATED + row] = -exponential_less_1(-step / tau) * tau
        s[FALLING_END + j] = -s[TAU + LANES + j] * s[KNOT + j]
        s[RISING_END + j] = s[TAU + 2 * LANES + j] * s[KNOT + j]
        s[ALWAYS + j] = s[RATED + j] * (s[KNOT + j] + s[FALLING_END + j] / s[TAU + j])
        last = 3 * LANES + j
        s[ALWAYS + last] = s[RATED + last] * (s[RISING_END + j] / s[TAU + last] - s[KNOT + j])


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _goal(s, j, slope):  # type: ignore[no-untyped-def]
    """The distance g(s) that a signal of this slope is followed at in the end."""
    rising, falling, knot = max(slope, 0.0), max(-slope, 0.0), s[KNOT + j]
    up = s[TAU + 2 * LANES + j] * min(rising, knot) + s[TAU + 3 * LANES + j] * max(rising - knot, 0.0)
    down = s[TAU + LANES + j] * min(falling, knot) + s[TAU + j] * max(falling - knot, 0.0)
    return up - down


@njit(cache=True, error_model="numpy", fastmath={"contract", "reassoc"})
def _moved_together(s: Array, step: float) -> float:
    """D and V of a group, as if every lane stayed in its piece; how many do not."""
    passed = 0.0
    for j in range(min(LANES, s.size & -LANES)):
        slope, d = (s[NOW + j] - s[BEFORE + j]) / step, s[D + j]
        downwards = _goal(s, j, slope) <= d
        low, high = s[FALLING_END + j], s[RISING_END + j]
        # at an end, the piece that is moved into
        first = (d < low) | ((d == low) & downwards)
        second = (d < 0.0) | ((d == 0.0) & downwards)
        third = (d < high) | ((d == high) & downwards)
        k0, k1, k2, k3 = s[KEPT + j], s[KEPT + LANES + j], s[KEPT + 2 * LANES + j], s[KEPT + 3 * LANES + j]
        r0, r1, r2, r3 = s[RATED + j], s[RATED + LANES + j], s[RATED + 2 * LANES + j], s[RATED + 3 * LANES + j]
        a0, a3 = s[ALWAYS + j], s[ALWAYS + 3 * LANES + j]
        kept = k0 if first else (k1 if second else (k2 if third else k3))
        rated = r0 if first else (r1 if second else (r2 if third else r3))
        always = a0 if first else (0.0 if third else a3)
        lowest = -np.inf if first else (low if second else (0.0 if third else high))
        highest = low if first else (0.0 if second else (high if third else np.inf))
        after = kept * d + (rated * slope + always)
        out = 1.0 if (after < lowest) | (after > highest) else 0.0
        s[LAST + j], s[D + j], s[V + j] = d, after, s[NOW + j] - after
        s[BEFORE + j], s[SLOPE + j], s[PASSED + j] = s[NOW + j], slope, out
        passed += out
    return passed


@njit(cache=True, error_model="numpy")
def _moved_alone(s: Array, j: int, step: float) -> float:
    """D of one lane, from piece to piece."""
    slope, d, knot = s[SLOPE + j], s[LAST + j], s[KNOT + j]
    ends = (s[FALLING_END + j], 0.0, s[RISING_END + j])
    upwards = _goal(s, j, slope) > d
    piece = 0
    for k in range(PIECES - 1):
        if ends[k] < d or (upwards and ends[k] == d):
            piece = k + 1
    left = step
    while True:
        tau = s[TAU + piece * LANES + j]
        if piece == 0:
            line = ends[0] + tau * (slope + knot)
        elif piece == PIECES - 1:
            line = ends[2] + tau * (slope - knot)
        else:
            line = tau * slope
        after = d + math.expm1(-left / tau) * (d - line)
        if upwards and piece < PIECES - 1 and after > ends[piece]:
            end, further = ends[piece], 1
        elif not upwards and piece > 0 and after < ends[piece - 1]:
            end, further = ends[piece - 1], -1
        else:
            return after
        left -= tau * math.log1p((d - end) / (end - line))
        d = end
        piece += further
        if left <= 0.0:
            return d


@njit(cache=True, error_model="numpy")
def lag_curve(time: Array, u: Array, knot: Array, constants: Array) -> Array:
    """What follows every column behind by a curve of its rate; in equilibrium with the first sample, v = u.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    linear between its samples
    knot : float64[swarm]                                 R > 0, unit of u over unit of time
    constants : float64[4, swarm]                         >= 0, unit of time: downwards beyond R, downwards up to R,
                                                          upwards up to R, upwards beyond R; all 0: v = u
    -> float64[samples, swarm]                            v, unit of u, within the range of u
    """
    samples, swarm = u.shape[0], knot.size
    v = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        for j in range(LANES):
            column = first + min(j, used - 1)
            s[KNOT + j] = knot[column]
            for k in range(PIECES):
                s[GIVEN + k * LANES + j] = constants[k, column]
        taken_in(s, BEFORE, u, 0, first, used)
        given_out(s, BEFORE, v, 0, first, used)
        known = 0.0
        for i in range(1, samples):
            step = time[i] - time[i - 1]
            if abs(step - known) > SAME_STEP * known:
                _prepared(s, step)
                known = step
            taken_in(s, NOW, u, i, first, used)
            if _moved_together(s, step) > 0.0:
                for j in range(LANES):
                    if s[PASSED + j] > 0.0:
                        s[D + j] = _moved_alone(s, j, step)
                        s[V + j] = s[NOW + j] - s[D + j]
            given_out(s, V, v, i, first, used)
    for j in range(swarm):
        if not np.any(constants[:, j] > 0.0):
            v[:, j] = u[:, j if u.shape[1] > 1 else 0]
    return v

"""A first-order lag whose time constant depends on where it is, of a swarm.

What follows a signal u obeys tau(v) dv/dt = u - v, in which tau is linear between evenly spaced levels and constant
beyond the outer ones. The exponential Rosenbrock method exprb32 of [1], of third order and exact where tau is constant
and u linear between its samples, whatever the ratio of step and time constant; what its second stage adds is the
estimate of its error, by which a step is cut into shorter ones.

With equal time constants it is the first-order lag of `lag`, with all of them 0 the signal itself, to the last bit.

[1] M. Hochbruck, A. Ostermann, Exponential integrators, Acta Numerica 19 (2010) 209-286.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, taken_in
from hysteresis_bench.kernels.elementary import exponential_less_1
from hysteresis_bench.kernels.lanes import LANES

LEVELS = 5

LEAST = 1e-9
"""Of the step, the shortest time constant: beside levels that lag, one of less counts as this and leaves no trace."""

SMALL = 1e-5
"""Of the range of the levels, what the second stage may add to a step that is not cut. Of made records of 100 and 3000
samples the answer was within 1e-4 and 1e-5 of a tight solution where tau changes sixfold, within 1e-3 and 6e-5 where it
changes sixteenfold next to a bend; with a tenth of it no better next to bends, at 100 samples in twice the time."""

NEAR = 1.0
"""Up to there the weights of a step are summed as series of ten terms."""

STIFFEST = 50.0
"""Growth over a step, as an exponent, that is not followed further: such a step is cut."""

PARTS = 16
"""Of a step, at most."""


# Rows of a group: the lowest level, levels a unit, time constants; then what is followed, what follows, and by how much
# holding tau at its first value would make a difference.
LOWEST, SCALE, CONSTANTS = 0, LANES, 2 * LANES
BEFORE, NOW, V, AFTER, WRONG = ((2 + LEVELS + row) * LANES for row in range(5))
ROWS = 7 + LEVELS


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _time_constant(s, j, v):  # type: ignore[no-untyped-def]
    """At a level, and how steeply it rises there."""
    place = (v - s[LOWEST + j]) * s[SCALE + j]
    tau, rise = s[CONSTANTS + j], 0.0
    for k in range(LEVELS - 1):
        more = s[CONSTANTS + (k + 1) * LANES + j] - s[CONSTANTS + k * LANES + j]
        tau += more * min(max(place - k, 0.0), 1.0)
        rise += more if k <= place < k + 1.0 else 0.0
    return tau, rise * s[SCALE + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _weights(z):  # type: ignore[no-untyped-def]
    """phi_1, phi_2 and phi_3 of [1]: (exp(z) - 1) / z, and on from each by (phi_k - 1 / k!) / z."""
    near = min(max(z, -NEAR), NEAR)
    third = 1.0 / 6.0 * (1.0 + near / 4.0 * (1.0 + near / 5.0 * (1.0 + near / 6.0 * (1.0 + near / 7.0))))
    last = near / 8.0 * (1.0 + near / 9.0 * (1.0 + near / 10.0 * (1.0 + near / 11.0 * (1.0 + near / 12.0))))
    third += 1.0 / 6.0 * near**4 / 840.0 * last
    second = 0.5 + near * third
    first = 1.0 + near * second
    far = exponential_less_1(z) / z
    farther = (far - 1.0) / z
    return (first, second, third) if abs(z) <= NEAR else (far, farther, (farther - 0.5) / z)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _moved(s, j, v, u, slope, step, least):  # type: ignore[no-untyped-def]
    """After a step from a signal that begins at u, and by how much the second stage changes it."""
    tau, rise = _time_constant(s, j, v)
    tau = max(tau, least)
    speed, faster = (u - v) / tau, slope / tau
    stiffness = min(-(1.0 + speed * rise) / tau, STIFFEST / step)
    first, second, third = _weights(step * stiffness)
    moved = step * (first * speed + step * second * faster)
    then, _ = _time_constant(s, j, v + moved)
    there = (u + slope * step - v - moved) / max(then, least)
    more = 2.0 * step * third * (there - speed - stiffness * moved - faster * step)
    end = u + slope * step
    low, high = min(min(u, end), v), max(max(u, end), v)
    return min(max(v + moved + more, low), high), abs(more)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _moved_together(s: Array, step: float) -> None:
    """AFTER of a group, in one step."""
    for j in range(min(LANES, s.size & -LANES)):
        slope = (s[NOW + j] - s[BEFORE + j]) / step
        after, wrong = _moved(s, j, s[V + j], s[BEFORE + j], slope, step, LEAST * step)
        s[WRONG + j] = wrong * s[SCALE + j] / (LEVELS - 1)
        s[AFTER + j] = after


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _moved_in_parts(s: Array, step: float) -> None:
    """The same, for those lanes of which one step is too long."""
    for j in range(LANES):
        if s[WRONG + j] > SMALL:
            parts = min(math.ceil((s[WRONG + j] / SMALL) ** (1.0 / 3.0)), PARTS)
            slope, part, v = (s[NOW + j] - s[BEFORE + j]) / step, step / parts, s[V + j]
            for k in range(parts):
                v, _ = _moved(s, j, v, s[BEFORE + j] + slope * part * k, slope, part, LEAST * step)
            s[AFTER + j] = v


@njit(cache=True, error_model="numpy")
def lag_with_level(time: Array, u: Array, lowest: Array, highest: Array, constants: Array) -> Array:
    """What follows every column with time constants of its level; in equilibrium with the first sample, v = u.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    linear between its samples
    lowest, highest : float64[swarm]                      the outer levels, lowest < highest, unit of u
    constants : float64[5, swarm]                         tau >= 0 at evenly spaced levels, unit of time; all 0: v = u
    -> float64[samples, swarm]                            v, unit of u, within the range of u
    """
    samples, swarm = u.shape[0], lowest.size
    v = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        for j in range(LANES):
            column = first + min(j, used - 1)
            s[LOWEST + j], s[SCALE + j] = lowest[column], (LEVELS - 1) / (highest[column] - lowest[column])
            for k in range(LEVELS):
                s[CONSTANTS + k * LANES + j] = constants[k, column]
        taken_in(s, NOW, u, 0, first, used)
        taken_in(s, AFTER, u, 0, first, used)
        given_out(s, AFTER, v, 0, first, used)
        for i in range(1, samples):
            step = time[i] - time[i - 1]
            for j in range(LANES):
                s[BEFORE + j], s[V + j] = s[NOW + j], s[AFTER + j]
            taken_in(s, NOW, u, i, first, used)
            _moved_together(s, step)
            _moved_in_parts(s, step)
            given_out(s, AFTER, v, i, first, used)
    for j in range(swarm):
        if not np.any(constants[:, j] > 0.0):
            v[:, j] = u[:, j if u.shape[1] > 1 else 0]
    return v

"""A first-order lag whose time constant depends on where it is, of a swarm.

What follows a signal u obeys tau(v) dv/dt = u - v, in which tau is linear between evenly spaced levels and constant
beyond the outer ones. With tau held over a step, the answer to a signal that is linear between its samples is exact
(see `lag`); it is held at its value in the middle of the step, which is found with tau at the beginning of it: the
exponential midpoint rule [1], of second order, whatever the ratio of step and time constant. A step on which holding
tau at its first value would make a difference is cut into shorter ones.

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

SMALL = 1e-6
"""Of the range of the levels, the difference between tau at the beginning and in the middle of a step that is not cut.
The answer of made records was within 5e-5 of a tight solution where tau changes tenfold, within 4e-4 where it falls to
a hundredth; with tenfold it within 6e-5 and 9e-4, in half the time."""

PARTS = 64
"""Of a step, at most."""


# Rows of a group: the lowest level, levels a unit, time constants; then what is followed, what follows, and by how much
# holding tau at its first value would make a difference.
LOWEST, SCALE, CONSTANTS = 0, LANES, 2 * LANES
BEFORE, NOW, V, AFTER, WRONG = ((2 + LEVELS + row) * LANES for row in range(5))
ROWS = 7 + LEVELS


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _time_constant(s, j, v):  # type: ignore[no-untyped-def]
    """At a level."""
    place = (v - s[LOWEST + j]) * s[SCALE + j]
    tau = s[CONSTANTS + j]
    for k in range(LEVELS - 1):
        more = s[CONSTANTS + (k + 1) * LANES + j] - s[CONSTANTS + k * LANES + j]
        tau += more * min(max(place - k, 0.0), 1.0)
    return tau


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _followed(v, u, slope, step, tau):  # type: ignore[no-untyped-def]
    """After a step with a time constant that is held, from a signal that begins at u."""
    decay = exponential_less_1(-step / tau)
    return v - decay * (u - v) + slope * (step + tau * decay)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _moved(s, j, v, u, slope, step, least):  # type: ignore[no-untyped-def]
    """After a step with the time constant in the middle of it, and with that at its beginning."""
    first = max(_time_constant(s, j, v), least)
    middle = _followed(v, u, slope, 0.5 * step, first)
    tau = max(_time_constant(s, j, middle), least)
    return _followed(v, u, slope, step, tau), _followed(v, u, slope, step, first)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _moved_together(s: Array, step: float) -> None:
    """V of a group after a step, in one."""
    for j in range(min(LANES, s.size & -LANES)):
        slope = (s[NOW + j] - s[BEFORE + j]) / step
        after, crude = _moved(s, j, s[V + j], s[BEFORE + j], slope, step, LEAST * step)
        s[WRONG + j] = abs(after - crude) * s[SCALE + j] / (LEVELS - 1)
        s[AFTER + j] = after


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _moved_in_parts(s: Array, step: float) -> None:
    """The same, for those lanes of which one step is too long."""
    for j in range(LANES):
        if s[WRONG + j] > SMALL:
            parts = min(math.ceil(math.sqrt(s[WRONG + j] / SMALL)), PARTS)
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

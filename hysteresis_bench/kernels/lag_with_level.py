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

LEAST = 1e-9
"""Of the step, the shortest time constant: beside levels that lag, one of less counts as this and leaves no trace."""

SMALL = 1e-5
"""Of the range of the levels, the difference between tau at the beginning and in the middle of a step that is not cut:
the answer is then within about a tenth of it. Twice it halves the time where tau changes tenfold."""

PARTS = 64
"""Of a step, at most."""


@njit(inline="always", error_model="numpy")
def _time_constant(v, low, scale, constants):  # type: ignore[no-untyped-def]
    """At a level; scale : pieces over the range of the levels"""
    place = (v - low) * scale
    tau = constants[0]
    for k in range(1, constants.size):
        tau += (constants[k] - constants[k - 1]) * min(max(place - (k - 1), 0.0), 1.0)
    return tau


@njit(inline="always", error_model="numpy")
def _followed(v, u, slope, step, tau):  # type: ignore[no-untyped-def]
    """After a step with a time constant that is held, from a signal that begins at u."""
    x = step / tau
    decay = math.expm1(-x)
    return v - decay * (u - v) + slope * (step + tau * decay)


@njit(inline="always", error_model="numpy")
def _moved(v, u, slope, step, least, low, scale, constants):  # type: ignore[no-untyped-def]
    """After a step with the time constant in the middle of it, and with that at its beginning."""
    first = max(_time_constant(v, low, scale, constants), least)
    middle = _followed(v, u, slope, 0.5 * step, first)
    tau = max(_time_constant(middle, low, scale, constants), least)
    return _followed(v, u, slope, step, tau), _followed(v, u, slope, step, first)


@njit(cache=True, error_model="numpy")
def lag_with_level(time: Array, u: Array, lowest: Array, highest: Array, constants: Array) -> Array:
    """What follows every column with time constants of its level; in equilibrium with the first sample, v = u.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    linear between its samples
    lowest, highest : float64[swarm]                      the outer levels, lowest < highest, unit of u
    constants : float64[levels, swarm]                    tau >= 0 at evenly spaced levels, unit of time; all 0: v = u
    -> float64[samples, swarm]                            v, unit of u, within the range of u
    """
    samples, columns, swarm = u.shape[0], u.shape[1], lowest.size
    v = np.empty((samples, swarm))
    for j in range(swarm):
        column = j if columns > 1 else 0
        own = constants[:, j].copy()
        lags = np.any(own > 0.0)
        scale = (own.size - 1) / (highest[j] - lowest[j])
        now = u[0, column]
        v[0, j] = now
        for i in range(1, samples):
            if lags:
                whole, before = time[i] - time[i - 1], u[i - 1, column]
                slope, least = (u[i, column] - before) / whole, LEAST * whole
                after, crude = _moved(now, before, slope, whole, least, lowest[j], scale, own)
                wrong = abs(after - crude) * scale / (own.size - 1)
                parts = min(math.ceil(math.sqrt(wrong / SMALL)), PARTS)
                if parts > 1:
                    step, after = whole / parts, now
                    for k in range(parts):
                        after, _ = _moved(after, before + slope * step * k, slope, step, least, lowest[j], scale, own)
                now = after
                v[i, j] = now
            else:
                v[i, j] = u[i, column]
    return v

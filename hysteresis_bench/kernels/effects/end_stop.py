"""An end stop on one side of the output of a swarm, in place.

What passes the level, x = max(d, 0) of the distance d beyond it, is rounded to a hyperbola: (d + sqrt(d² + w²)) / 2.
"""

from __future__ import annotations

import math

from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def stop_above(y: Array, level: Array, share: Array, rounding: Array) -> None:
    """y - share x in place of y, x what passes the level.

    y : float64[samples, swarm]     overwritten
    level : float64[swarm]          unit of y
    share : float64[swarm]          of what passes the level, held back; above 1 it comes back; 0: y to the last bit
    rounding : float64[swarm]       w >= 0, unit of y; 0: a corner
    """
    samples, swarm = y.shape
    for i in range(samples):
        for j in range(swarm):
            beyond = y[i, j] - level[j]
            y[i, j] -= 0.5 * share[j] * (beyond + math.sqrt(beyond * beyond + rounding[j] * rounding[j]))


@njit(cache=True, error_model="numpy")
def stop_below(y: Array, level: Array, share: Array, rounding: Array) -> None:
    """y + share x in place of y, x what falls short of the level; the arguments as in `stop_above`."""
    samples, swarm = y.shape
    for i in range(samples):
        for j in range(swarm):
            short = level[j] - y[i, j]
            y[i, j] += 0.5 * share[j] * (short + math.sqrt(short * short + rounding[j] * rounding[j]))

"""A dead zone about any centre, its edges rounded to hyperbolas, for a swarm.

Within it d, the distance from the centre, is held: held(d) = min(max(d, -w), w), w the half-width, which is
(|d + w| - |d - w|) / 2, with sqrt(x² + r²) in the place of |x|, r the rounding.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _held(d, half_width, square):  # type: ignore[no-untyped-def]
    """square : of the rounding"""
    beyond, before = d + half_width, d - half_width
    return 0.5 * (math.sqrt(beyond * beyond + square) - math.sqrt(before * before + square))


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def rounded_dead_zone(x: Array, share: Array, half_width: Array, centre: Array, rounding: Array) -> Array:
    """x - share (held(x - centre) - held(-centre)), so that 0 stays 0.

    x : float64[samples, 1] shared by the swarm, or float64[samples, swarm]
    share : float64[swarm]           of the motion within the dead zone that does not pass
    half_width : float64[swarm]      >= 0, unit of x; 0: x to the last bit
    centre : float64[swarm]          unit of x
    rounding : float64[swarm]        >= 0, unit of x; 0: corners
    -> float64[samples, swarm], C order
    """
    samples, swarm, shared = x.shape[0], share.size, x.shape[1] == 1
    square, at_zero = np.empty(swarm), np.empty(swarm)
    for j in range(swarm):
        square[j] = rounding[j] * rounding[j]
        at_zero[j] = _held(-centre[j], half_width[j], square[j])
    y = np.empty((samples, swarm))
    for i in range(samples):
        for j in range(swarm):
            one = x[i, 0] if shared else x[i, j]
            y[i, j] = one - share[j] * (_held(one - centre[j], half_width[j], square[j]) - at_zero[j])
    return y

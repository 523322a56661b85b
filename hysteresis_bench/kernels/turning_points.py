"""Where a signal turns."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def turning_points(u: Array, resolution: float) -> Array:
    """Samples at which the signal turns by more than the resolution: the extremum itself, not where it is noticed.

    u : float64[samples]             any unit; its ends are no turning points
    resolution : unit of u, >= 0     movements up to this are none
    -> int64[reversals]              rising
    """
    turns = np.empty(u.size, dtype=np.int64)
    found = 0
    high = low = 0
    heading = 0
    for i in range(u.size):
        value = u[i]
        if heading >= 0 and value > u[high]:
            high = i
        if heading <= 0 and value < u[low]:
            low = i
        if heading >= 0 and u[high] - value > resolution:
            if heading > 0:
                turns[found] = high
                found += 1
            heading, low = -1, i
        elif heading <= 0 and value - u[low] > resolution:
            if heading < 0:
                turns[found] = low
                found += 1
            heading, high = 1, i
    return turns[:found].copy()

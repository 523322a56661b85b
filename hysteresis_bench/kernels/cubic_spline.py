"""Columns of a cubic spline on even intervals."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def cubic_spline(x: Array, knots: Array) -> Array:
    """x, x², x³, and the cubic B-splines, as columns.

    x : float64[samples]      within the knots
    knots : float64[knots]    rising, the first and the last four times, even between them
    -> float64[samples, 3 + knots - 4]

    [1]  B_(i,k) = (x - t_i) / (t_(i+k) - t_i) B_(i,k-1) + (t_(i+k+1) - x) / (t_(i+k+1) - t_(i+1)) B_(i+1,k-1)
    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), chapter X.
    """
    splines = knots.size - 4
    intervals = splines - 3
    low, high = knots[0], knots[-1]
    columns = np.zeros((x.size, 3 + splines))
    value = np.empty(4)
    for i in range(x.size):
        at = x[i]
        columns[i, 0], columns[i, 1], columns[i, 2] = at, at * at, at * at * at
        interval = min(max(int(intervals * (at - low) / (high - low)), 0), intervals - 1)
        k = interval + 3
        value[0] = 1.0
        for degree in range(1, 4):
            carried = 0.0
            for j in range(degree):
                right, left = knots[k + 1 + j], knots[k + 1 + j - degree]
                share = value[j] / (right - left)
                value[j] = carried + (right - at) * share
                carried = (at - left) * share
            value[degree] = carried
        for j in range(4):
            columns[i, 3 + interval + j] = value[j]
    return columns

"""Divided differences: what is left of a signal where a polynomial is taken off it, sample by sample."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def divided_differences(time: Array, values: Array, order: int, lag: int) -> Array:
    """Divided differences of a signal, with weights whose squares sum to 1: white noise keeps its RMS.

    time : float64[samples]      strictly increasing, any spacing
    values : float64[samples]    any unit
    order : of the difference, at least 1; polynomials of a lower degree vanish
    lag : distance of the samples compared, at least 1
    -> float64[samples - order * lag]    unit of the values

    Weights are 1 / prod_(k != j) (t_j - t_k), in units of the window's duration, so that no product underflows.
    """
    windows = values.size - order * lag
    found = np.empty(windows)
    products = np.empty(order + 1)
    for i in range(windows):
        scale = 1.0 / (time[i + order * lag] - time[i])
        products[:] = 1.0
        for j in range(order + 1):
            for k in range(j + 1, order + 1):
                gap = (time[i + j * lag] - time[i + k * lag]) * scale
                products[j] *= gap
                products[k] *= -gap
        total = 0.0
        squares = 0.0
        for j in range(order + 1):
            weight = 1.0 / products[j]
            total += weight * values[i + j * lag]
            squares += weight * weight
        found[i] = total / math.sqrt(squares)
    return found

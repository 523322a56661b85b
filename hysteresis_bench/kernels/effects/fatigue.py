"""Loss of amplitude with the path of the input, in place."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import exponential


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def fade(y: Array, u: Array, rate: Array) -> None:
    """y exp(-rate s) in place of y, s the length of the input's path since the first sample.

    y : float64[samples, swarm]                           overwritten
    u : float64[samples, 1] or float64[samples, swarm]    input
    rate : float64[swarm]                                 1 / unit of u; 0: y to the last bit
    """
    samples, swarm = y.shape
    columns = u.shape[1]
    path = np.zeros(columns)
    for i in range(1, samples):
        if columns > 1:
            for j in range(columns):
                path[j] += abs(u[i, j] - u[i - 1, j])
                y[i, j] *= exponential(-rate[j] * path[j])
        else:
            path[0] += abs(u[i, 0] - u[i - 1, 0])
            shared = path[0]
            for j in range(swarm):
                y[i, j] *= exponential(-rate[j] * shared)

"""Sum of squared errors of a swarm against one measured output."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def sum_of_squares(simulated: Array, measured: Array) -> Array:
    """Squared error summed over the samples, for every column.

    simulated : float64[samples, swarm]
    measured : float64[samples]
    -> float64[swarm]
    """
    samples, swarm = simulated.shape
    total = np.zeros(swarm)
    for i in range(samples):
        target = measured[i]
        for j in range(swarm):
            error = simulated[i, j] - target
            total[j] += error * error
    return total

"""Errors of a swarm against one measured output, and the sum of their squares."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

TOGETHER = 4
"""Samples that are added before a sum goes back to memory, where the next addition would wait for it."""


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def sum_of_squares(simulated: Array, measured: Array) -> Array:
    """Squared error summed over the samples, for every column.

    simulated : float64[samples, swarm]
    measured : float64[samples]
    -> float64[swarm]
    """
    samples, swarm = simulated.shape
    total = np.zeros(swarm)
    whole = samples - samples % TOGETHER
    for i in range(0, whole, TOGETHER):
        for j in range(swarm):
            known = total[j]
            for k in range(TOGETHER):
                error = simulated[i + k, j] - measured[i + k]
                known += error * error
            total[j] = known
    for i in range(whole, samples):
        for j in range(swarm):
            error = simulated[i, j] - measured[i]
            total[j] += error * error
    return total


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def residuals_into(out: Array, simulated: Array, measured: Array, limit: float) -> None:
    """Simulated minus measured, cut at +-limit, which is also what NaN is worth.

    out, simulated : float64[samples, swarm]
    measured : float64[samples]
    """
    samples, swarm = simulated.shape
    for i in range(samples):
        target = measured[i]
        for j in range(swarm):
            error = simulated[i, j] - target
            bounded = error if error < limit else limit
            out[i, j] = bounded if bounded > -limit else -limit

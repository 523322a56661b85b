"""One constant a column, by which its mean is what was measured.

numpy adds and subtracts along short rows one row at a time, which takes several times as long for the few columns of a
descent.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def missing(simulated: Array, history: int, mean: float) -> Array:
    """What the mean of every column lacks, (swarm,): as numpy's mean has it, to the last bit.

    simulated : float64[samples, swarm];  history : samples before those that count;  mean : that is asked
    """
    samples, swarm = simulated.shape
    total = np.zeros(swarm)
    for i in range(history, samples):
        for j in range(swarm):
            total[j] += simulated[i, j]
    for j in range(swarm):
        total[j] = mean - total[j] / (samples - history)
    return total


@njit(cache=True, error_model="numpy")
def raised(simulated: Array, offset: Array) -> Array:
    """simulated : float64[samples, swarm];  offset : float64[swarm] -> their sum, float64[samples, swarm]"""
    samples, swarm = simulated.shape
    out = np.empty((samples, swarm))
    for i in range(samples):
        for j in range(swarm):
            out[i, j] = simulated[i, j] + offset[j]
    return out

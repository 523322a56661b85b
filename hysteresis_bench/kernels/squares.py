"""Errors of a swarm against one measured output, the sum of their squares, and how they differ between points."""

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


@njit(cache=True, error_model="numpy")
def differences_into(first: Array, differences: Array, found: Array) -> None:
    """Groups of columns parted: the first of each, and the others less it.

    first : float64[groups, samples];  differences : float64[groups, samples, others]
    found : float64[samples, groups, 1 + others]
    """
    groups, samples, others = differences.shape
    for group in range(groups):
        for i in range(samples):
            base = found[i, group, 0]
            first[group, i] = base
            for j in range(others):
                differences[group, i, j] = found[i, group, j + 1] - base


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

"""What the output of a swarm collects from a current that is a polynomial of the input, in place."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

ORDERS = 7
"""Powers of the input: known to the compiler, which unrolls the loop over them."""


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _mean(before, now, currents, j):  # type: ignore[no-untyped-def]
    """Of the current, along a straight line: that of z^k is the sum of z_0^(k - m) z_1^m, over k + 1."""
    total, powers, last = 0.0, 1.0, 1.0
    for k in range(ORDERS):
        last = last * now
        powers = powers * before + last
        total += currents[k, j] / (k + 2.0) * powers
    return total


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def collect(y: Array, time: Array, u: Array, largest: Array, currents: Array) -> None:
    """y + integral of sum_k currents[k - 1] (u / largest)^k dt in place of y, from the first sample.

    Exact for an input that is linear between its samples.

    y : float64[samples, swarm]                           overwritten
    time : float64[samples]                               any spacing
    u : float64[samples, 1] or float64[samples, swarm]    input
    largest : float64[swarm]                              unit of u, > 0
    currents : float64[ORDERS, swarm]                     unit of y over unit of time; all 0: y to the last bit
    """
    samples, swarm = y.shape
    scale, collected = 1.0 / largest, np.zeros(swarm)
    before, now = np.empty(swarm), np.empty(swarm)
    for j in range(swarm):
        now[j] = u[0, j if u.shape[1] > 1 else 0] * scale[j]
    for i in range(1, samples):
        step = time[i] - time[i - 1]
        for j in range(swarm):
            before[j] = now[j]
            now[j] = (u[i, j] if u.shape[1] > 1 else u[i, 0]) * scale[j]
        for j in range(swarm):
            collected[j] += step * _mean(before[j], now[j], currents, j)
            y[i, j] += collected[j]

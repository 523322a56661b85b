"""A first-order high-pass of a share of every column, in place, exact for a signal that is linear between its samples.

y = x - share (lag(x) - x_0), lag(x) = x + e with the deviation e of `kernels.lag`: what is passed of the share is what
the lag is behind by.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.linear_stage import SAME_STEP


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def droop(y: Array, time: Array, rate: Array, share: Array) -> None:
    """y = x - share (z - x_0), dz/dt = rate (x - z), z = x at the first sample, in place of x.

    y : float64[samples, swarm]     x, overwritten
    time : float64[samples]         strictly increasing, any spacing
    rate : float64[swarm]           inverse time constant, 1 / unit of time; 0: x to the last bit
    share : float64[swarm]          of the response that runs back
    """
    samples, swarm = y.shape
    kept, passed, deviation = np.ones(swarm), np.ones(swarm), np.zeros(swarm)
    first, before, known = y[0].copy(), y[0].copy(), 0.0
    for i in range(1, samples):
        step = time[i] - time[i - 1]
        if abs(step - known) > SAME_STEP * known:
            known = step
            for j in range(swarm):
                x = step * rate[j]
                kept[j] = math.exp(-x)
                passed[j] = -math.expm1(-x) / x if x > 0.0 else 1.0
        for j in range(swarm):
            now = y[i, j]
            deviation[j] = kept[j] * deviation[j] - passed[j] * (now - before[j])
            before[j] = now
            y[i, j] = now - share[j] * (now - first[j] + deviation[j]) if rate[j] > 0.0 else now

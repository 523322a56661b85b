"""A pure delay of a swarm: exact for a signal that is linear between its samples, on any time grid."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def delay(time: Array, u: Array, duration: Array) -> Array:
    """v(t) = u(t - duration), linear between the samples of u and constant before the first one.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]
    duration : float64[swarm]                             >= 0, unit of time; 0: v = u to the last bit
    -> float64[samples, swarm]                            v, unit of u
    """
    samples, columns = u.shape
    swarm = duration.size
    v = np.empty((samples, swarm))
    sample = np.zeros(swarm, dtype=np.int64)  # the last one that is not after t - duration
    for i in range(samples):
        for j in range(swarm):
            column = j if columns > 1 else 0
            then = time[i] - duration[j]
            k = sample[j]
            while k < i and time[k + 1] <= then:
                k += 1
            sample[j] = k
            if k == i or then <= time[0]:
                v[i, j] = u[k, column]
            else:
                share = (then - time[k]) / (time[k + 1] - time[k])
                v[i, j] = u[k, column] + share * (u[k + 1, column] - u[k, column])
    return v

"""A swarm's responses as clocks show them that run fast or slow, linear between the samples."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def clock(time: Array, u: Array, rate: Array) -> Array:
    """v(t) = u(t_0 + (1 + rate) (t - t_0)), t_0 the first sample, constant after the last one.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]
    rate : float64[swarm]                                 > -1; 0: v = u to the last bit
    -> float64[samples, swarm]                            v, unit of u
    """
    samples, columns = u.shape
    v = np.empty((samples, rate.size))
    place = np.zeros(rate.size, dtype=np.int64)  # of the sample before what is shown
    for i in range(samples):
        for j in range(rate.size):
            column = j if columns > 1 else 0
            if rate[j] == 0.0 or samples == 1:
                v[i, j] = u[i, column]
                continue
            shown = time[i] + rate[j] * (time[i] - time[0])
            k = place[j]
            while k < samples - 2 and time[k + 1] <= shown:
                k += 1
            place[j] = k
            share = min((shown - time[k]) / (time[k + 1] - time[k]), 1.0)
            v[i, j] = u[k, column] + share * (u[k + 1, column] - u[k, column])
    return v

"""What repeats itself along a course, added to the output or the input of a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import cosine_and_sine


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def add_ripple(y: Array, course: Array, period: Array, waves: Array) -> None:
    """y + sum over n of a_n sin(n w) + b_n cos(n w) in place of y, w = 2 pi course / period.

    y : float64[samples, swarm]               overwritten
    course : float64[samples, 1 or swarm]     may be y itself
    period : float64[swarm]                   unit of the course
    waves : float64[2 harmonics, swarm]       a_1, b_1, a_2, b_2 ..., unit of y; all 0: y to the last bit
    """
    samples, swarm = y.shape
    shared = course.shape[1] == 1
    frequency = 1.0 / period
    c, s, c_n, s_n = np.empty(swarm), np.empty(swarm), np.empty(swarm), np.empty(swarm)
    for i in range(samples):
        if shared:
            x = course[i, 0]
            for j in range(swarm):
                c[j], s[j] = cosine_and_sine(frequency[j] * x)
        else:
            for j in range(swarm):
                c[j], s[j] = cosine_and_sine(frequency[j] * course[i, j])
        c_n[:], s_n[:] = c, s
        for n in range(0, waves.shape[0], 2):
            for j in range(swarm):
                y[i, j] += waves[n, j] * s_n[j] + waves[n + 1, j] * c_n[j]
                ahead = c_n[j] * c[j] - s_n[j] * s[j]
                s_n[j] = s_n[j] * c[j] + c_n[j] * s[j]
                c_n[j] = ahead

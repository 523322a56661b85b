"""A sinusoid that swells and fades along a spline, added to the output of a swarm at the phase that a record shows."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.effects.natural_spline import Curves, splines_at
from hysteresis_bench.kernels.elementary import cosine_and_sine


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def add_at_own_phase(y: Array, time: Array, measured: Array, frequency: Array, amplitude: Curves) -> None:
    """y + a(s) cos(p + q) in place of y, p = 2 pi f t, s = t - t_0, with the phase q of the largest correlation with
    what is missing: the least-squares estimate over whole periods.

    y : float64[samples, swarm]            overwritten
    time : float64[samples]                t, any spacing
    measured : float64[last samples]       of the output; what is missing is measured - y, less its mean
    frequency : float64[swarm]             f, 1 / unit of time
    amplitude : a curve of s, a, unit of y; 0: y to the last bit
    """
    low, scale, extremes, knots, pieces = amplitude
    swarm, first = low.size, time.size - measured.size
    a, left = np.empty(swarm), np.zeros(swarm)
    waves, missing = np.zeros((2, swarm)), np.zeros((2, swarm))
    for i in range(first, time.size):
        splines_at(time[i] - time[0], low, scale, extremes, knots, pieces, a)
        for j in range(swarm):
            c, s = cosine_and_sine(frequency[j] * time[i])
            lacking = measured[i - first] - y[i, j]
            left[j] += lacking
            waves[0, j] += a[j] * c
            waves[1, j] += a[j] * s
            missing[0, j] += lacking * a[j] * c
            missing[1, j] += lacking * a[j] * s
    for j in range(swarm):
        c = missing[0, j] - left[j] / measured.size * waves[0, j]
        s = missing[1, j] - left[j] / measured.size * waves[1, j]
        size = np.sqrt(c * c + s * s)
        missing[0, j] = c / size if size > 0.0 else 0.0
        missing[1, j] = s / size if size > 0.0 else 0.0
    for i in range(time.size):
        splines_at(time[i] - time[0], low, scale, extremes, knots, pieces, a)
        for j in range(swarm):
            c, s = cosine_and_sine(frequency[j] * time[i])
            y[i, j] += a[j] * (missing[0, j] * c + missing[1, j] * s)

"""A wave with overtones whose fundamental swells and fades along splines, added to the output of a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.effects.natural_spline import Curves, splines_at
from hysteresis_bench.kernels.elementary import cosine_and_sine


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def add_wave(y: Array, time: Array, frequency: Array, cosine: Curves, sine: Curves, overtones: Array) -> None:
    """y + a(s) cos(p) + b(s) sin(p) + overtones 2 and 3 in place of y, p = 2 pi f t, s = t - t_0.

    y : float64[samples, swarm]            overwritten
    time : float64[samples]                t, any spacing
    frequency : float64[swarm]             f, 1 / unit of time
    cosine, sine : curves of s, a and b, unit of y, on the same knots
    overtones : float64[4, swarm]          of cos(2 p), sin(2 p), cos(3 p), sin(3 p), unit of y; all 0, with a and b: y
    """
    low, scale, extremes, knots, cosines = cosine
    sines = sine.pieces
    a, b = np.empty(low.size), np.empty(low.size)
    for i in range(time.size):
        splines_at(time[i] - time[0], low, scale, extremes, knots, cosines, a)
        splines_at(time[i] - time[0], low, scale, extremes, knots, sines, b)
        for j in range(low.size):
            c, s = cosine_and_sine(frequency[j] * time[i])
            c2, s2 = c * c - s * s, 2.0 * (c * s)
            c3, s3 = c2 * c - s2 * s, s2 * c + c2 * s
            wave = a[j] * c + b[j] * s
            y[i, j] += wave + overtones[0, j] * c2 + overtones[1, j] * s2 + overtones[2, j] * c3 + overtones[3, j] * s3

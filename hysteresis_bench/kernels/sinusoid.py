"""Sinusoids of a swarm on any time grid: rotated from sample to sample where the grid is even."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.linear_stage import SAME_STEP

ANCHOR = 32
"""After so many rotations the sinusoid is computed anew, so that rounding does not add up."""


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def add_sinusoid(y: Array, time: Array, cosine: Array, sine: Array, frequency: Array) -> None:
    """y + cosine cos(2 pi f t) + sine sin(2 pi f t) in place of y.

    y : float64[samples, swarm]         overwritten
    time : float64[samples]             any spacing
    cosine, sine : float64[swarm]       amplitudes, unit of y; both 0: y to the last bit
    frequency : float64[swarm]          f, 1 / unit of time
    """
    samples, swarm = y.shape
    inphase = np.empty(swarm)
    quadrature = np.empty(swarm)
    forward = np.empty(swarm)
    aside = np.empty(swarm)
    known = 0.0
    for i in range(samples):
        step = time[i] - time[i - 1] if i > 0 else 0.0
        even = abs(step - known) <= SAME_STEP * known
        if even and i % ANCHOR != 0:
            for j in range(swarm):
                ahead = inphase[j] * forward[j] + quadrature[j] * aside[j]
                quadrature[j] = quadrature[j] * forward[j] - inphase[j] * aside[j]
                inphase[j] = ahead
                y[i, j] += ahead
        else:
            for j in range(swarm):
                phase = 2.0 * math.pi * frequency[j] * time[i]
                inphase[j] = cosine[j] * math.cos(phase) + sine[j] * math.sin(phase)
                quadrature[j] = sine[j] * math.cos(phase) - cosine[j] * math.sin(phase)
                y[i, j] += inphase[j]
            if not even:
                known = step
                for j in range(swarm):
                    forward[j] = math.cos(2.0 * math.pi * frequency[j] * step)
                    aside[j] = math.sin(2.0 * math.pi * frequency[j] * step)

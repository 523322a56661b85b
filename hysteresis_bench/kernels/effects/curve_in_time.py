"""A given course in time acts on the output of a swarm, in place: drift, offsets, temperature."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def add(y: Array, course: Array, rate: Array) -> None:
    """y + rate course in place of y.

    y : float64[samples, swarm]     overwritten
    course : float64[samples]
    rate : float64[swarm]           unit of y over unit of course; 0: y to the last bit
    """
    samples, swarm = y.shape
    for i in range(samples):
        now = course[i]
        for j in range(swarm):
            y[i, j] += rate[j] * now


@njit(cache=True, error_model="numpy")
def scale_and_add(y: Array, course: Array, gain: Array, rate: Array) -> None:
    """y (1 + gain course) + rate course in place of y; the arguments as in `add`, gain in 1 / unit of course."""
    samples, swarm = y.shape
    for i in range(samples):
        now = course[i]
        for j in range(swarm):
            y[i, j] = y[i, j] * (1.0 + gain[j] * now) + rate[j] * now


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def products(y: Array, course: Array) -> Array:
    """sum_i course_i y_ij, of every column; with a course of 1 / samples its mean.

    y : float64[samples, swarm];  course : float64[samples]
    -> float64[swarm]
    """
    samples, swarm = y.shape
    total = np.zeros(swarm)
    for i in range(samples):
        now = course[i]
        for j in range(swarm):
            total[j] += now * y[i, j]
    return total

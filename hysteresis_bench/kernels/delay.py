"""A pure delay of a swarm: exact for a signal that is linear between its samples, on any time grid."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

SAME_TIME = 8e-16
"""Times that differ by less than this share of the largest are the same but for rounding."""


@njit(cache=True, error_model="numpy")
def _even_step(time: Array) -> float:
    """The step of an even grid, 0 where the grid is not even."""
    samples = time.size
    step = (time[-1] - time[0]) / max(samples - 1, 1)
    furthest = 0.0
    for i in range(samples):
        furthest = max(furthest, abs(time[i] - (time[0] + i * step)))
    return step if furthest <= SAME_TIME * max(abs(time[0]), abs(time[-1])) else 0.0


@njit(cache=True, error_model="numpy")
def _delay_evenly(u: Array, steps: Array, v: Array) -> None:
    """`delay` on an even grid, by so many steps: every column has one whole number of samples and one share.

    steps : float64[swarm], >= 0
    """
    samples, columns = u.shape
    swarm = steps.size
    flat = u.ravel()
    share = np.empty(swarm)
    start = np.empty(swarm, dtype=np.int64)  # where column j of the sample that arrives at the first one would be
    before = np.empty(swarm)
    for j in range(swarm):
        whole = min(np.floor(steps[j]), samples)
        share[j] = steps[j] - whole if whole < samples else 0.0
        start[j] = (j if columns > 1 else 0) - int(whole) * columns
        before[j] = u[0, j if columns > 1 else 0]
    for i in range(samples):
        for j in range(swarm):
            place = start[j] + i * columns
            now = flat[place] if place >= 0 else before[j]
            v[i, j] = now - share[j] * (now - before[j])
            before[j] = now


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
    step = _even_step(time)
    if step > 0.0:
        _delay_evenly(u, duration / step, v)
        return v
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

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


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _delay_unevenly(time: Array, u: Array, duration: Array, v: Array) -> None:
    """`delay` on any grid. Columns look for the samples between which their own past lies side by side, one sample
    further at a time; indices that cannot be negative let that be vectorised."""
    samples, columns = u.shape
    flat = u.ravel().copy()  # what might overlap with v would not be vectorised
    begin = np.empty(duration.size, dtype=np.uint64)  # of the stretch between samples in which t - duration lies
    place = np.empty(duration.size, dtype=np.uint64)  # of what a column has there
    for j in range(duration.size):
        begin[j] = 0
        place[j] = j if columns > 1 else 0
        v[0, j] = u[0, j if columns > 1 else 0]
    end, inverse = time[1:].copy(), 1.0 / (time[1:] - time[:-1])  # numba has no diff of read-only arrays
    end[-1:] = np.inf
    one, row = np.uint64(1), np.uint64(columns)
    for i in range(1, samples):
        moved = one
        while moved > 0:
            moved = np.uint64(0)
            for j in range(duration.size):
                past = np.uint64(end[begin[j]] <= time[i] - duration[j])
                begin[j] += past
                moved += past
        for j in range(duration.size):
            k = begin[j]
            share = max((time[i] - duration[j] - time[k]) * inverse[k], 0.0)
            before = flat[place[j] + k * row]
            v[i, j] = before + share * (flat[place[j] + k * row + row] - before)
    for j in range(duration.size):
        if duration[j] == 0.0:
            v[samples - 1, j] = u[samples - 1, j if columns > 1 else 0]


@njit(cache=True, error_model="numpy")
def delay(time: Array, u: Array, duration: Array) -> Array:
    """v(t) = u(t - duration), linear between the samples of u and constant before the first one.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]
    duration : float64[swarm]                             >= 0, unit of time; 0: v = u to the last bit
    -> float64[samples, swarm]                            v, unit of u
    """
    v = np.empty((time.size, duration.size))
    step = _even_step(time)
    if step > 0.0:
        _delay_evenly(u, duration / step, v)
        return v
    _delay_unevenly(time, u, duration, v)
    return v

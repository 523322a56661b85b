"""A pure delay of a swarm: exact for a signal that is linear between its samples, on any time grid."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

SAME_TIME = 8e-16
"""Times that differ by less than this share of the largest are the same but for rounding."""

WIDEST = 2.0
"""Steps by which the times of a nearly even grid lie apart from an even one."""

TOGETHER = 128
"""Samples of a column that are looked for together: enough for the vectors, and their results stay in cache."""


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
def _spread(time: Array, step: float) -> float:
    """How far times lie from an even grid, the latest against the earliest and no less than rounding moves them."""
    earliest = latest = 0.0
    for i in range(time.size):
        off = time[i] - (time[0] + i * step)
        earliest, latest = min(earliest, off), max(latest, off)
    return latest - earliest + 5.0 * SAME_TIME * max(abs(time[0]), abs(time[-1]))


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _delay_unevenly(time: Array, u: Array, duration: Array, v: Array) -> None:
    """`delay` on any grid: a column looks for the samples between which its past lies, TOGETHER of them at a time.

    On a nearly even grid they are known but for a few, and how many of those have passed is counted without a branch;
    on any other they are found one sample after the other.
    """
    samples, columns = u.shape
    inputs, outputs = u.ravel(), v.reshape(v.size)
    row, wide, one = np.uint64(columns), np.uint64(duration.size), np.uint64(1)
    step = (time[-1] - time[0]) / (samples - 1)
    spread = _spread(time, step)
    near = spread < WIDEST * step
    few = int(2.0 * spread / step) + 1 if near else 0  # samples that may have passed or not
    origin = samples  # where the first sample stands: what lies before it has passed, the last one never does
    passing = np.full(2 * samples + few, np.inf)
    passing[: origin + 1] = -np.inf
    inverse = np.empty(samples - 1)
    for i in range(1, samples):
        inverse[i - 1] = 1.0 / (time[i] - time[i - 1])
    for i in range(1, samples - 1):
        passing[origin + i] = time[i]
    reached = np.zeros(duration.size, dtype=np.uint64)
    past, begin = np.empty(TOGETHER), np.empty(TOGETHER, dtype=np.uint64)
    for j in range(duration.size):
        v[0, j] = u[0, j if columns > 1 else 0]
    for first in range(1, samples, TOGETHER):
        block = np.uint64(min(TOGETHER, samples - first))
        for j in range(duration.size):
            for i in range(block):
                past[i] = max(time[np.uint64(first) + i] - duration[j], time[0])
            if near:
                known = first - int(min(np.ceil((duration[j] + spread) / step), samples))  # of the first one
                begin[:] = 0
                for k in range(origin + known + 1, origin + known + 1 + few):
                    for i in range(block):
                        begin[i] += np.uint64(passing[np.uint64(k) + i] <= past[i])
                for i in range(block):
                    begin[i] = np.uint64(max(np.int64(i + begin[i]) + known, np.int64(0)))
            else:
                place = reached[j]
                for i in range(block):
                    while passing[np.uint64(origin) + place + one] <= past[i]:
                        place += one
                    begin[i] = place
                reached[j] = place
            column, into = np.uint64(j if columns > 1 else 0), np.uint64(first * duration.size + j)
            for i in range(block):
                k = begin[i]
                before = inputs[k * row + column]
                share = (past[i] - time[k]) * inverse[k]
                outputs[i * wide + into] = before + share * (inputs[k * row + row + column] - before)
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

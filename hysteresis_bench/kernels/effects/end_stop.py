"""An end stop on one side of the output of a swarm, in place."""

from __future__ import annotations

from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def stop_above(y: Array, level: Array, share: Array) -> None:
    """y - share max(y - level, 0) in place of y.

    y : float64[samples, swarm]     overwritten
    level : float64[swarm]          unit of y
    share : float64[swarm]          0 to 1 of what passes the level is held back; 0: y to the last bit
    """
    samples, swarm = y.shape
    for i in range(samples):
        for j in range(swarm):
            y[i, j] -= share[j] * max(y[i, j] - level[j], 0.0)


@njit(cache=True, error_model="numpy")
def stop_below(y: Array, level: Array, share: Array) -> None:
    """y + share max(level - y, 0) in place of y; the arguments as in `stop_above`."""
    samples, swarm = y.shape
    for i in range(samples):
        for j in range(swarm):
            y[i, j] += share[j] * max(level[j] - y[i, j], 0.0)

"""A continuous curve of straight pieces, as a sum of one-sided dead zones, for a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def dead_zones(x: Array, centre: Array, slope: Array, edges: Array, slopes: Array) -> Array:
    """slope x + sum of slopes[l] times what x - centre goes beyond edges[l], on the edge's own side of 0.

    x : float64[samples, swarm]           any unit
    centre, slope : float64[swarm]        where all edges are counted from, unit of x; slope there, output over x
    edges : float64[zones, swarm]         unit of x; max(x - centre - edge, 0) above 0, min(x - centre - edge, 0) below
    slopes : float64[zones, swarm]        change of the slope at the edge, unit of the output over that of x
    -> float64[samples, swarm]            unit of the output

    [1] K. Kuhnen, European Journal of Control 9 (2003) 407, equation (19).
    """
    samples, swarm = x.shape
    y = np.empty((samples, swarm))
    for i in range(samples):
        for j in range(swarm):
            y[i, j] = slope[j] * x[i, j]
        for zone in range(slopes.shape[0]):
            for j in range(swarm):
                edge = edges[zone, j]
                beyond = x[i, j] - centre[j] - edge
                y[i, j] += slopes[zone, j] * (max(beyond, 0.0) if edge >= 0.0 else min(beyond, 0.0))
    return y

"""Bouc-Wen hysteresis with eddy currents inside: `bouc_wen` and `eddy_current` say what each is."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import paths
from hysteresis_bench.kernels.bouc_wen_step import RUNAWAY
from hysteresis_bench.kernels.bouc_wen_tried import ROWS, kept, prepared, tried
from hysteresis_bench.kernels.eddy_bouc_wen_linear import eddy_bouc_wen_linear
from hysteresis_bench.kernels.eddy_current import COEFFICIENT, NEW, simulated
from hysteresis_bench.kernels.lanes import GROUPS, LANES, Y, Z


@njit(cache=True, error_model="numpy")
def _tried(n: float, work: Array, left: Array) -> None:
    for g in range(left.size):
        if left[g] > 0:
            tried(n, work[g])


@njit(cache=True, error_model="numpy")
def _kept(n: float, work: Array) -> None:
    for g in range(work.shape[0]):
        kept(n, work[g])


@njit(cache=True, error_model="numpy")
def eddy_bouc_wen(
    time: Array,
    u: Array,
    coefficient: Array,
    alpha: Array,
    beta: Array,
    gamma: Array,
    d: Array,
    n: float,
) -> Array:
    """v of a swarm, where z = u - coefficient dv/dt acts in place of u.

    time : float64[samples]           strictly increasing
    coefficient : float64[swarm]      >= 0, unit of u times unit of time over unit of v
    the others, and the result, as in `bouc_wen` (n = 1) and `bouc_wen_power`
    -> float64[samples, swarm]        C order; at rest at the first sample, z = u there
    """
    if n == 1.0:
        return eddy_bouc_wen_linear(time, u, coefficient, alpha, beta, gamma, d)
    samples, columns = u.shape
    swarm = d.size
    length = paths(u)
    v = np.empty((samples, swarm))
    for first in range(0, swarm, GROUPS * LANES):
        work = np.zeros((min(GROUPS, (swarm - first + LANES - 1) // LANES), ROWS * LANES))
        for g in range(work.shape[0]):
            s = work[g]
            for j in range(LANES):
                p = min(first + g * LANES + j, swarm - 1)
                column = p if columns > 1 else 0
                prepared(s, j, alpha[p], beta[p], gamma[p], d[p], RUNAWAY * length[column])
                s[COEFFICIENT + j] = coefficient[p]
                s[NEW + j] = u[0, column]
                s[Z + j] = u[0, column]
                s[Y + j] = d[p] * u[0, column]
                v[0, p] = s[Y + j]
        simulated(_tried, _kept, n, work, time, u, first, v)
    return v

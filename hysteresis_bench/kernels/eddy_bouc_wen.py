"""Bouc-Wen hysteresis with eddy currents inside: `bouc_wen` and `eddy_current` say what each is."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import paths
from hysteresis_bench.kernels.bouc_wen_step import RUNAWAY, moved
from hysteresis_bench.kernels.eddy_current import acting

# Parameters and state of one particle; NEXT is h where the last trial ended.
LOOP, BETA, GAMMA, SLOPE, POWER, BOUND, INPUT, H, NEXT = range(9)


@njit(cache=True, error_model="numpy")
def _advanced(s: Array, z: float) -> float:
    """v where the acting input has moved on to z; h goes to NEXT."""
    s[NEXT] = moved(s[H], z - s[INPUT], s[LOOP], s[BETA], s[GAMMA], s[POWER], s[BOUND])
    return s[SLOPE] * z - s[NEXT]


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
    samples, columns = u.shape
    swarm = d.size
    length, _ = paths(u)
    v = np.empty((samples, swarm))
    s = np.zeros(9)
    for j in range(swarm):
        column = j if columns > 1 else 0
        s[LOOP] = alpha[j] * d[j]
        s[BETA] = beta[j]
        s[GAMMA] = gamma[j]
        s[SLOPE] = d[j]
        s[POWER] = n
        s[BOUND] = RUNAWAY * abs(s[LOOP]) * length[column]
        s[INPUT] = u[0, column]
        s[H] = 0.0
        v[0, j] = d[j] * u[0, column]
        for i in range(1, samples):
            rate = coefficient[j] / (time[i] - time[i - 1])
            s[INPUT], v[i, j] = acting(_advanced, s, s[INPUT], v[i - 1, j], u[i - 1, column], u[i, column], rate)
            s[H] = s[NEXT]
    return v

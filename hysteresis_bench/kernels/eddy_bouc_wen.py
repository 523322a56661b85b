"""Bouc-Wen hysteresis with eddy currents inside: `bouc_wen` and `eddy_current` say what each is."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import RUNAWAY, STEEPEST, _integrated, _regrown, _weakened
from hysteresis_bench.kernels.eddy_current import acting

# Parameters and state of one particle; NEXT is h where the last trial ended.
LOOP, BETA, GAMMA, SLOPE, POWER, BOUND, INPUT, H, NEXT = range(9)


@njit(cache=True, error_model="numpy")
def _advanced(s: Array, z: float) -> float:
    """v where the acting input has moved on to z; h goes to NEXT."""
    step = z - s[INPUT]
    width = abs(step)
    h = s[H]
    if width > 0.0:
        mirror = 1.0 if s[LOOP] >= 0.0 else -1.0
        sign = mirror if step > 0.0 else -mirror
        g = sign * h
        drive = abs(s[LOOP])
        along, against = s[BETA] + mirror * s[GAMMA], s[BETA] - mirror * s[GAMMA]
        if s[POWER] != 1.0:
            g = _integrated(g, drive, along, against, s[POWER], width, s[BOUND]) if drive > 0.0 else g
        else:
            rate = max(against if g < 0.0 else along, -STEEPEST / width)  # cut as in `bouc_wen`, against overflow
            free = g + (drive - rate * g) * _weakened(rate, width)
            g = _regrown(g, drive, along, against, width) if g < 0.0 and free > 0.0 else free
            g = min(max(g, -s[BOUND]), s[BOUND])
        h = sign * g
    s[NEXT] = h
    return s[SLOPE] * z - h


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
    v = np.empty((samples, swarm))
    s = np.zeros(9)
    for j in range(swarm):
        column = j if columns > 1 else 0
        length = 0.0
        for i in range(1, samples):
            length += abs(u[i, column] - u[i - 1, column])
        s[LOOP] = alpha[j] * d[j]
        s[BETA] = beta[j]
        s[GAMMA] = gamma[j]
        s[SLOPE] = d[j]
        s[POWER] = n
        s[BOUND] = RUNAWAY * abs(s[LOOP]) * length
        s[INPUT] = u[0, column]
        s[H] = 0.0
        v[0, j] = d[j] * u[0, column]
        for i in range(1, samples):
            rate = coefficient[j] / (time[i] - time[i - 1])
            s[INPUT], v[i, j] = acting(_advanced, s, s[INPUT], v[i - 1, j], u[i - 1, column], u[i, column], rate)
            s[H] = s[NEXT]
    return v

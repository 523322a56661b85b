"""A bank of play operators whose positions enter by polynomials, for a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.play import centred, played


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def play_bank(u: Array, radii: Array, coefficients: Array) -> Array:
    """sum over plays k and powers m = 1, 2, ... of coefficients[k, m - 1] P_k^m, P_k the play of half-width radii[k].

    Rate-independent, exact for an input that is monotone between its samples. Every play starts in the middle of its
    dead band, P_k = u at the first sample.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    radii : float64[plays, swarm]                         half-widths, unit of u, >= 0; 0: the input itself
    coefficients : float64[plays, powers, swarm]          unit of the output over the unit of u to the power
    -> float64[samples, swarm]                            unit of the output

    [1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
    """
    samples, columns = u.shape
    plays, powers, swarm = coefficients.shape
    state = centred(u, plays, swarm)
    value = np.empty(swarm)
    y = np.zeros((samples, swarm))
    for i in range(samples):
        for k in range(plays):
            if powers == 1:  # the same in one pass
                for j in range(swarm):
                    now = u[i, j] if columns > 1 else u[i, 0]
                    place = played(now, radii[k, j], state[k, j])
                    state[k, j] = place
                    y[i, j] += place * coefficients[k, 0, j]
                continue
            for j in range(swarm):
                now = u[i, j] if columns > 1 else u[i, 0]
                state[k, j] = played(now, radii[k, j], state[k, j])
                value[j] = coefficients[k, powers - 1, j]
            for m in range(powers - 2, 0, -1):
                for j in range(swarm):
                    value[j] = coefficients[k, m, j] + state[k, j] * value[j]
            for j in range(swarm):
                y[i, j] += state[k, j] * (coefficients[k, 0, j] + state[k, j] * value[j])
    return y

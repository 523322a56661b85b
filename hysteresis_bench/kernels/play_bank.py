"""A bank of play operators whose positions enter by polynomials, for a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import FEW, FULL, LANES
from hysteresis_bench.kernels.play import centred, played

TOGETHER = 6
"""Plays that a column goes through before its sum goes back to memory."""

RADIUS, PLACE, WEIGHT = (np.uint64(row * LANES) for row in range(3))
PLAY = np.uint64(3 * LANES)
"""Rows of one array, for every play; unsigned, as in `bouc_wen`."""


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _weighted(u: Array, radii: Array, weights: Array, first: int, y: Array) -> None:
    """`play_bank` of the first power, for the LANES particles from `first` on, into y; what pads them is overwritten
    by the particles that follow, but for the last sample. A play that pads the others has no weight."""
    samples, swarm = y.shape
    plays, shared = weights.shape[0], u.shape[1] == 1
    inputs, outputs = u.ravel(), y.reshape(samples * swarm)
    used = min(LANES, swarm - first)
    full = -(-used // FULL) * FULL if used > FEW else used
    groups = -(-plays // TOGETHER)
    rows, work = np.zeros((3 * TOGETHER * groups, LANES)), np.zeros(2 * LANES)
    bank, now, total = rows.reshape(rows.size), np.uint64(0), np.uint64(LANES)
    for j in range(used):
        for k in range(plays):
            rows[3 * k, j], rows[3 * k + 2, j] = radii[k, first + j], weights[k, first + j]
            rows[3 * k + 1, j] = u[0, 0] if shared else u[0, first + j]
    for i in range(samples):
        lanes = np.uint64(full if i + 1 < samples else used)
        row = np.uint64(i * swarm + first)
        for j in range(lanes):
            work[now + j] = u[i, 0] if shared else inputs[row + j]
            work[total + j] = 0.0
        for group in range(groups):
            start = np.uint64(group * TOGETHER) * PLAY
            for j in range(lanes):
                x, summed = work[now + j], work[total + j]
                for k in range(TOGETHER):
                    at = start + np.uint64(k) * PLAY + j
                    place = played(x, bank[at + RADIUS], bank[at + PLACE])
                    bank[at + PLACE] = place
                    summed += place * bank[at + WEIGHT]
                work[total + j] = summed
        for j in range(lanes):
            outputs[row + j] = work[total + j]


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
    y = np.zeros((samples, swarm))
    if powers == 1:
        for first in range((swarm - 1) // LANES * LANES, -1, -LANES):  # the last ones first, for their padding
            _weighted(u, radii, coefficients[:, 0], first, y)
        return y
    state = centred(u, plays, swarm)
    value = np.empty(swarm)
    for i in range(samples):
        for k in range(plays):
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

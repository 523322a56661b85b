"""Jiles-Atherton hysteresis with eddy currents inside: `jiles_atherton` and `eddy_current` say what each is."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.eddy_current import acting
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic

# Parameters and state of one particle, as in `jiles_atherton`; the NEXT ones are where the last trial ended.
ALPHA, A, K, M_S, C, CLAMPED, FIELD, LAST, MI, D, M, RISE_D, RISE_M, NEXT_MI, NEXT_D, NEXT_M = range(16)


@njit(cache=True, error_model="numpy")
def _response(s: Array, z: float) -> float:
    """B where the acting field has moved on to z: the step of `jiles_atherton`, for one particle."""
    dH = z - s[FIELD]
    if dH == 0.0:
        s[NEXT_MI], s[NEXT_D], s[NEXT_M] = s[MI], s[D], s[M]
        return MU0 * (z + s[M])
    s[NEXT_MI], s[NEXT_D], s[NEXT_M] = advanced(
        z, abs(dH), math.copysign(1.0, dH), extrapolated(dH, s[LAST]),
        s[ALPHA], 1.0 / s[A], s[ALPHA] * s[M_S] / s[A], s[K], s[M_S], s[C],
        s[MI], s[D], s[M], s[RISE_D], s[RISE_M], s[CLAMPED] != 0.0,
    )  # fmt: skip
    return MU0 * (z + s[NEXT_M])


@njit(cache=True, error_model="numpy")
def _kept(s: Array, z: float) -> None:
    """What the last trial found is the state."""
    if z == s[FIELD]:
        return
    s[RISE_D] = s[NEXT_D] - s[D]
    s[RISE_M] = s[NEXT_M] - s[M]
    s[MI], s[D], s[M] = s[NEXT_MI], s[NEXT_D], s[NEXT_M]
    s[LAST] = z - s[FIELD]
    s[FIELD] = z


@njit(cache=True, error_model="numpy")
def eddy_jiles_atherton(
    time: Array,
    H: Array,
    coefficient: Array,
    alpha: Array,
    a: Array,
    k: Array,
    M_s: Array,
    c: Array,
    clamped: bool,
) -> Array:
    """B of a swarm, where z = H - coefficient dB/dt acts in place of the field H: B = mu0 (z + M).

    time : float64[samples]           strictly increasing
    coefficient : float64[swarm]      >= 0, unit of H times unit of time over unit of B
    the others, and the result, as in `jiles_atherton`
    -> float64[samples, swarm]        C order; z = H at the first sample
    """
    samples, swarm = H.shape[0], alpha.size
    B = np.empty((samples, swarm))
    for j in range(swarm):
        column = j if H.shape[1] > 1 else 0
        s = np.zeros(16)
        s[ALPHA], s[A], s[K], s[M_S], s[C] = alpha[j], a[j], k[j], M_s[j], c[j]
        s[CLAMPED] = 1.0 if clamped else 0.0
        s[FIELD] = H[0, column]
        s[D] = first_anhysteretic(H[0, column], alpha[j], a[j], M_s[j], c[j])
        s[M] = c[j] * s[D]
        B[0, j] = MU0 * (H[0, column] + s[M])
        for i in range(1, samples):
            rate = coefficient[j] / (time[i] - time[i - 1])
            z, B[i, j] = acting(_response, s, s[FIELD], B[i - 1, j], H[i - 1, column], H[i, column], rate)
            _kept(s, z)
    return B

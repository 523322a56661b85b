"""Jiles-Atherton hysteresis with eddy currents inside: `jiles_atherton` and `eddy_current` say what each is."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from hysteresis_bench.kernels.eddy_current import acting
from hysteresis_bench.kernels.jiles_atherton import GROWTH, MU0, STEEPEST, first_anhysteretic
from hysteresis_bench.kernels.langevin import langevin_ratio

# Parameters and state of one particle, as in `jiles_atherton`; the NEXT ones are where the last trial ended.
ALPHA, A, K, M_S, C, CLAMPED, FIELD, LAST, MI, D, M, RISE_D, RISE_M, NEXT_MI, NEXT_D, NEXT_M = range(16)


@njit(cache=True, error_model="numpy")
def _advanced(s: NDArray, z: float) -> float:
    """B where the acting field has moved on to z: the step of `jiles_atherton`, for one particle."""
    dH = z - s[FIELD]
    if dH == 0.0:
        s[NEXT_MI], s[NEXT_D], s[NEXT_M] = s[MI], s[D], s[M]
        return MU0 * (z + s[M])
    h, delta = abs(dH), math.copysign(1.0, dH)
    ahead = min(dH / s[LAST], GROWTH) if dH * s[LAST] > 0.0 else 0.0
    alpha, c, M_s = s[ALPHA], s[C], s[M_S]
    M_ahead = s[M] + ahead * s[RISE_M]
    x = (z + alpha * M_ahead) / s[A]
    ratio = langevin_ratio(x)

    kappa = s[K] - alpha * delta * (s[D] + 0.5 * ahead * s[RISE_D])
    if s[CLAMPED] != 0.0:
        kappa = max(kappa, 0.0)
    u = kappa + h
    w = h / (kappa * kappa + u * u)
    L = x * ratio
    Ma = M_s * L
    Ma_slope = alpha * M_s / s[A] * (1.0 - L * L - 2.0 * ratio)
    Mi_slope = w * u
    behind = max(delta * s[D], 0.0) * delta if s[CLAMPED] != 0.0 else s[D]
    change = w * (kappa * behind + u * (Ma - s[MI]))
    if s[CLAMPED] != 0.0 and delta * change <= 0.0:
        change, Mi_slope = 0.0, 0.0
    Mi = s[MI] + change
    M_found = Mi + c * (Ma - Mi)  # (11)
    steepness = (c + (1.0 - c) * Mi_slope) * Ma_slope
    correction = Ma_slope * (M_found - M_ahead) / (1.0 - min(steepness, STEEPEST))
    Ma_found = min(max(Ma + correction, -M_s), M_s)
    s[NEXT_MI] = Mi + Mi_slope * (Ma_found - Ma)
    s[NEXT_D] = Ma_found - s[NEXT_MI]
    s[NEXT_M] = s[NEXT_MI] + c * s[NEXT_D]
    return MU0 * (z + s[NEXT_M])


@njit(cache=True, error_model="numpy")
def _kept(s: NDArray, z: float) -> None:
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
    time: NDArray,
    H: NDArray,
    coefficient: NDArray,
    alpha: NDArray,
    a: NDArray,
    k: NDArray,
    M_s: NDArray,
    c: NDArray,
    clamped: bool,
) -> NDArray:
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
            z, B[i, j] = acting(_advanced, s, s[FIELD], B[i - 1, j], H[i - 1, column], H[i, column], rate)
            _kept(s, z)
    return B

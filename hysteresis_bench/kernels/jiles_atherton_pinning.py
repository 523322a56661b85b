"""Jiles-Atherton hysteresis whose pinning depends on the magnetization, for a swarm.

The step is that of `jiles_atherton`, clamped, with k (1 + kappa (1 - (M / M_s)^2)) in place of k, M as it was before
the step, extrapolated to its middle.

[1] D. C. Jiles, J. B. Thoelke, M. K. Devine, IEEE Trans. Magnetics 28 (1992) 27: k as a function of M.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.jiles_atherton import LANES, MU0, advanced, extrapolated, first_anhysteretic

LEAST = 1e-3
"""The pinning does not fall below this share of k."""

# Rows of a group of lanes: parameters and state as in `jiles_atherton`, the field that comes next, and the output.
ALPHA, INVERSE_A, PULL, K, M_S, C, KAPPA, MI, D, M, RISE_D, RISE_M, FIELD, LAST, NEXT, OUT = (
    row * LANES for row in range(16)
)
ROWS = 16


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _advance(s: Array) -> None:
    """All lanes of a group on to the next field; one that stays where it is keeps its state."""
    for j in range(LANES):
        field, Mi, D_, M_ = s[NEXT + j], s[MI + j], s[D + j], s[M + j]
        rise_D, rise_M, last, M_s = s[RISE_D + j], s[RISE_M + j], s[LAST + j], s[M_S + j]
        dH = field - s[FIELD + j]
        ahead = extrapolated(dH, last)
        share = (M_ + 0.5 * ahead * rise_M) / M_s
        pinned = s[K + j] * max(1.0 + s[KAPPA + j] * (1.0 - min(share * share, 1.0)), LEAST)
        new_Mi, new_D, new_M = advanced(
            field, abs(dH), math.copysign(1.0, dH), ahead,
            s[ALPHA + j], s[INVERSE_A + j], s[PULL + j], pinned, M_s, s[C + j], Mi, D_, M_, rise_D, rise_M, True,
        )  # fmt: skip
        moved = dH != 0.0
        M_found = new_M if moved else M_
        s[RISE_D + j] = new_D - D_ if moved else rise_D
        s[RISE_M + j] = new_M - M_ if moved else rise_M
        s[MI + j] = new_Mi if moved else Mi
        s[D + j] = new_D if moved else D_
        s[M + j] = M_found
        s[LAST + j] = dH if moved else last
        s[FIELD + j] = field
        s[OUT + j] = MU0 * (field + M_found)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def jiles_atherton_pinning(H: Array, alpha: Array, a: Array, k: Array, M_s: Array, c: Array, kappa: Array) -> Array:
    """B = mu0 (H + M) of a swarm.

    H, alpha, a, k, M_s, c : as in `jiles_atherton`
    kappa : float64[swarm]     how much stronger the pinning is at M = 0 than at saturation, as a share of the latter
    -> float64[samples, swarm]; for kappa = 0 that of `jiles_atherton`, clamped
    """
    samples, columns = H.shape
    swarm = alpha.size
    B = np.empty((samples, swarm))
    work = np.zeros(((swarm + LANES - 1) // LANES, ROWS * LANES))
    for g in range(work.shape[0]):
        s = work[g]
        for j in range(LANES):
            p = min(g * LANES + j, swarm - 1)
            field = H[0, p if columns > 1 else 0]
            s[ALPHA + j] = alpha[p]
            s[INVERSE_A + j] = 1.0 / a[p]
            s[PULL + j] = alpha[p] * M_s[p] / a[p]
            s[K + j] = k[p]
            s[M_S + j] = M_s[p]
            s[C + j] = c[p]
            s[KAPPA + j] = kappa[p]
            s[D + j] = first_anhysteretic(field, alpha[p], a[p], M_s[p], c[p])
            s[M + j] = c[p] * s[D + j]
            s[FIELD + j] = field
            B[0, p] = MU0 * (field + s[M + j])
    for i in range(1, samples):
        for g in range(work.shape[0]):
            for j in range(LANES):
                work[g, NEXT + j] = H[i, min(g * LANES + j, swarm - 1) if columns > 1 else 0]
        for g in range(work.shape[0]):
            _advance(work[g])
        for g in range(work.shape[0]):
            for j in range(min(LANES, swarm - g * LANES)):
                B[i, g * LANES + j] = work[g, OUT + j]
    return B

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
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic

LEAST = 1e-3
"""The pinning does not fall below this share of k."""


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
    for j in range(swarm):
        column = j if columns > 1 else 0
        field = H[0, column]
        inverse_a = 1.0 / a[j]
        pull = alpha[j] * M_s[j] / a[j]
        D = first_anhysteretic(field, alpha[j], a[j], M_s[j], c[j])
        M = c[j] * D
        Mi = rise_D = rise_M = last = 0.0
        B[0, j] = MU0 * (field + M)
        for i in range(1, samples):
            dH = H[i, column] - field
            if dH != 0.0:
                field = H[i, column]
                ahead = extrapolated(dH, last)
                last = dH
                share = (M + 0.5 * ahead * rise_M) / M_s[j]
                pinned = k[j] * max(1.0 + kappa[j] * (1.0 - min(share * share, 1.0)), LEAST)
                Mi, D_new, M_new = advanced(
                    field, abs(dH), math.copysign(1.0, dH), ahead,
                    alpha[j], inverse_a, pull, pinned, M_s[j], c[j], Mi, D, M, rise_D, rise_M, True,
                )  # fmt: skip
                rise_D, rise_M = D_new - D, M_new - M
                D, M = D_new, M_new
            B[i, j] = MU0 * (field + M)
    return B

"""Jiles-Atherton hysteresis with eddy currents inside: `jiles_atherton` and `eddy_current` say what each is."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.eddy_current import COEFFICIENT, NEW, simulated
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic
from hysteresis_bench.kernels.lanes import GROUPS, LANES, LAW, OUT, TRIAL, Y, Z

# Rows of a group: parameters and state as in `jiles_atherton`, and, in the same order, what the last trial found.
ALPHA, INVERSE_A, PULL, K, M_S, C = ((LAW + row) * LANES for row in range(6))
LAST, MI, D, M, RISE_D, RISE_M = ((LAW + row) * LANES for row in range(6, 12))
FOUND = 6 * LANES
WIDTH = (LAW + 18) * LANES


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _tried(s, clamped):  # type: ignore[no-untyped-def]
    """B where the acting field has moved on to the trial; clamped : a constant where it is called."""
    for j in range(LANES):
        z = s[TRIAL + j]
        dH = z - s[Z + j]
        Mi, D_, M_ = advanced(
            z, abs(dH), math.copysign(1.0, dH), extrapolated(dH, s[LAST + j]),
            s[ALPHA + j], s[INVERSE_A + j], s[PULL + j], s[K + j], s[M_S + j], s[C + j],
            s[MI + j], s[D + j], s[M + j], s[RISE_D + j], s[RISE_M + j], clamped,
        )  # fmt: skip
        moved = dH != 0.0
        before = s[M + j]
        found = M_ if moved else before  # for itself: the compiler would read back what it has just stored
        s[FOUND + LAST + j] = dH if moved else s[LAST + j]
        s[FOUND + MI + j] = Mi if moved else s[MI + j]
        s[FOUND + D + j] = D_ if moved else s[D + j]
        s[FOUND + M + j] = found
        s[FOUND + RISE_D + j] = D_ - s[D + j] if moved else s[RISE_D + j]
        s[FOUND + RISE_M + j] = M_ - before if moved else s[RISE_M + j]
        s[OUT + j] = MU0 * (z + found)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _response(clamped: bool, s: Array) -> None:
    if clamped:
        _tried(s, True)
    else:
        _tried(s, False)


@njit(cache=True, error_model="numpy")
def _kept(clamped: bool, s: Array) -> None:
    """What the last trial found is the state."""
    for row in range(LAST, LAST + FOUND):
        s[row] = s[FOUND + row]


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
    for first in range(0, swarm, GROUPS * LANES):
        work = np.zeros((min(GROUPS, (swarm - first + LANES - 1) // LANES), WIDTH))
        for g in range(work.shape[0]):
            s = work[g]
            for j in range(LANES):
                p = min(first + g * LANES + j, swarm - 1)
                field = H[0, p if H.shape[1] > 1 else 0]
                s[COEFFICIENT + j] = coefficient[p]
                s[ALPHA + j] = alpha[p]
                s[INVERSE_A + j] = 1.0 / a[p]
                s[PULL + j] = alpha[p] * M_s[p] / a[p]
                s[K + j] = k[p]
                s[M_S + j] = M_s[p]
                s[C + j] = c[p]
                s[D + j] = first_anhysteretic(field, alpha[p], a[p], M_s[p], c[p])
                s[M + j] = c[p] * s[D + j]
                s[NEW + j] = field
                s[Z + j] = field
                s[Y + j] = MU0 * (field + s[M + j])
                B[0, p] = s[Y + j]
        simulated(_response, _kept, clamped, work, time, H, first, B)
    return B

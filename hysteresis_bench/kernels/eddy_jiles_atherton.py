"""Jiles-Atherton hysteresis with eddy currents inside: `jiles_atherton` and `eddy_current` say what each is."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.eddy_current import COEFFICIENT, NEW, simulated
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic
from hysteresis_bench.kernels.lanes import GROUPS, LANES, LAW, OUT, TRIAL, Y, Z

# Rows of a group: parameters and state as in `jiles_atherton`, and what the last trial found.
ALPHA, INVERSE_A, PULL, K, M_S, C = ((LAW + row) * LANES for row in range(6))
LAST, MI, D, M, RISE_D, RISE_M, FOUND_MI, FOUND_D, FOUND_M = ((LAW + row) * LANES for row in range(6, 15))
WIDTH = (LAW + 15) * LANES


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _tried(s, left, clamped):  # type: ignore[no-untyped-def]
    """B where the acting field has moved on to the trial; clamped : a constant where it is called."""
    for g in range(left.size):
        if left[g] == 0:
            continue
        for j in range(LANES):
            z = s[g, TRIAL + j]
            dH = z - s[g, Z + j]
            Mi, D_, M_ = advanced(
                z, abs(dH), math.copysign(1.0, dH), extrapolated(dH, s[g, LAST + j]),
                s[g, ALPHA + j], s[g, INVERSE_A + j], s[g, PULL + j], s[g, K + j], s[g, M_S + j], s[g, C + j],
                s[g, MI + j], s[g, D + j], s[g, M + j], s[g, RISE_D + j], s[g, RISE_M + j], clamped,
            )  # fmt: skip
            found = M_ if dH != 0.0 else s[g, M + j]
            s[g, FOUND_MI + j] = Mi
            s[g, FOUND_D + j] = D_
            s[g, FOUND_M + j] = M_
            s[g, OUT + j] = MU0 * (z + found)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _response(clamped: bool, s: Array, left: Array) -> None:
    if clamped:
        _tried(s, left, True)
    else:
        _tried(s, left, False)


@njit(cache=True, error_model="numpy")
def _kept(clamped: bool, s: Array) -> None:
    """What the last trial found is the state, where it has moved."""
    for g in range(s.shape[0]):
        for j in range(min(LANES, s.shape[1])):
            dH = s[g, TRIAL + j] - s[g, Z + j]
            moved = dH != 0.0
            Mi, D_, M_ = s[g, MI + j], s[g, D + j], s[g, M + j]
            found_Mi, found_D, found_M = s[g, FOUND_MI + j], s[g, FOUND_D + j], s[g, FOUND_M + j]
            last, rise_D, rise_M = s[g, LAST + j], s[g, RISE_D + j], s[g, RISE_M + j]
            s[g, LAST + j] = dH if moved else last
            s[g, MI + j] = found_Mi if moved else Mi
            s[g, D + j] = found_D if moved else D_
            s[g, M + j] = found_M if moved else M_
            s[g, RISE_D + j] = found_D - D_ if moved else rise_D
            s[g, RISE_M + j] = found_M - M_ if moved else rise_M


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

"""Jiles-Atherton hysteresis, equations (1) to (12) of the SMA paper, for a swarm.

[1] "Jiles-Atherton based hysteresis identification of shape memory alloy-actuating compliant mechanism
    via modified particle swarm optimization algorithm", section 3.

Legend: H field, M magnetization, Mi irreversible magnetization M_irr, Ma anhysteretic magnetization
M_an, D = Ma - Mi, h = |dH|.

Between two samples (5) reads dMi/dH = D / (k delta - alpha D). Ours: with kappa = k - alpha delta D
taken at the extrapolated middle of the step, and Ma a straight line in H over the step, it is linear;
its exponential is replaced by exp(-s) = 1 / (1 + s + s^2/2), s = h / kappa, which gives

    dMi = h (kappa D + u (Ma' - Mi)) / (kappa^2 + u^2),    u = kappa + h,  Ma' at the step's end.

Second order; L-stable: Mi follows Ma without ringing however far h exceeds k; and without a pole, so
that it stays finite where (5) does not. M is implicit through H_eff = H + alpha M: extrapolated from
the last two samples, then corrected by one Newton step that evaluates (11) and its slope at once.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.langevin import langevin_ratio

MU0 = 4e-7 * math.pi
LANES = 8
"""Particles that advance together; a swarm is padded to a multiple with copies of its last particle."""
GROWTH = 4.0
"""Extrapolation reaches at most this many of the last step's lengths, or rounding would speak."""
STEEPEST = 0.9
"""Slope of (11) in M beyond which Newton's step is no longer lengthened: past 1 there are several M."""

# Rows of a group of lanes: parameters (PULL = alpha M_s / a), state, last changes of the state, and the
# field where every particle has its own. One flat array with constant offsets: LLVM then sees that
# rows do not overlap, and vectorises across the lanes.
ALPHA, INVERSE_A, PULL, K, M_S, C, MI, D, M, RISE_D, RISE_M, FIELD, NEXT, LAST = (row * LANES for row in range(14))
GROUP = 14 * LANES


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def first_anhysteretic(H: float, alpha: float, a: float, M_s: float, c: float) -> float:
    """M_an(H + alpha M) where M_irr = 0 and thus M = c M_an, (11): the solution on H's side, 0 at H = 0.

    Newton from M_an = +-M_s: the curve is convex from there on, so that it ends at the outermost solution.
    """
    Ma = math.copysign(M_s, H) if H != 0.0 else 0.0
    for _ in range(100):
        x = (H + alpha * c * Ma) / a
        ratio = langevin_ratio(x)
        steepness = c * M_s * alpha / a * (1.0 - x * ratio * x * ratio - 2.0 * ratio)
        change = (Ma - M_s * x * ratio) / max(1.0 - steepness, 1.0 - STEEPEST)
        Ma -= change
        if abs(change) <= 1e-15 * abs(Ma):
            break
    return Ma


@njit(forceinline=True, error_model="numpy")
def extrapolated(dH, last):  # type: ignore[no-untyped-def]
    """How far to extrapolate the last changes: dH over the last dH where the direction is kept, else 0."""
    return min(dH / last, GROWTH) if dH * last > 0.0 else 0.0


# forceinline: a call in the innermost loop would keep it from being vectorised.
@njit(cache=True, error_model="numpy", fastmath={"contract"}, forceinline=True)
def advanced(H, h, delta, ahead, alpha, inverse_a, pull, k, M_s, c, Mi, D_, M_, rise_D, rise_M, clamped):  # type: ignore[no-untyped-def]
    """One particle, one sample on to H: the new Mi, D, M.

    h, delta : |dH| > 0 and its sign (6)
    ahead : `extrapolated(dH, last dH)`
    clamped : a constant where it is called, so that neither treatment of reversal costs the other anything
    """
    M_ahead = M_ + ahead * rise_M
    x = (H + alpha * M_ahead) * inverse_a
    ratio = langevin_ratio(x)

    kappa = k - alpha * (delta * D_ + 0.5 * delta * ahead * rise_D)  # the denominator of (5), times delta
    if clamped:
        kappa = max(kappa, 0.0)  # ours: past the pole of (5) Mi jumps to Ma
    u = kappa + h
    w = h / (kappa * kappa + u * u)
    L = x * ratio
    Ma = M_s * L
    Ma_slope = pull * (1.0 - L * L - 2.0 * ratio)  # dMa/dM
    Mi_slope = w * u  # dMi/dMa
    if clamped:
        D_from = delta * max(delta * D_, 0.0)  # while behind, Mi waits until Ma has come back to it
        change = delta * max(delta * (w * (kappa * D_from + u * (Ma - Mi))), 0.0)
        Mi_slope = Mi_slope if change != 0.0 else 0.0
    else:
        change = w * (kappa * D_ + u * (Ma - Mi))
    Mi += change
    M_found = Mi + c * (Ma - Mi)  # (11)
    steepness = (c + (1.0 - c) * Mi_slope) * Ma_slope  # dM_found/dM_ahead
    correction = Ma_slope * (M_found - M_ahead) / (1.0 - min(steepness, STEEPEST))
    Ma_found = min(max(Ma + correction, -M_s), M_s)
    Mi += Mi_slope * (Ma_found - Ma)
    D_ = Ma_found - Mi
    return Mi, D_, Mi + c * D_


# Inlined into four kernels, so that neither a treatment of reversal nor a kind of input costs the others anything.
@njit(error_model="numpy", fastmath={"contract"}, inline="always")
def _simulated(H, alpha, a, k, M_s, c, clamped, shared):  # type: ignore[no-untyped-def]
    """clamped, shared : constants where it is called; the arguments and the result as in `jiles_atherton`."""
    samples, swarm = H.shape[0], alpha.size
    groups = (swarm + LANES - 1) // LANES
    # A group is written whole; what it writes past the end of a row, the next row overwrites.
    output = np.empty(samples * swarm + LANES)
    s = np.zeros(groups * GROUP)
    for g in range(groups):
        for j in range(LANES):
            o, p = g * GROUP + j, min(g * LANES + j, swarm - 1)
            field = H[0, 0 if shared else p]
            s[o + ALPHA] = alpha[p]
            s[o + INVERSE_A] = 1.0 / a[p]
            s[o + PULL] = alpha[p] * M_s[p] / a[p]
            s[o + K] = k[p]
            s[o + M_S] = M_s[p]
            s[o + C] = c[p]
            s[o + D] = first_anhysteretic(field, alpha[p], a[p], M_s[p], c[p])
            s[o + M] = c[p] * s[o + D]
            s[o + FIELD] = field
            output[p] = MU0 * (field + s[o + M])

    last = 0.0
    for i in range(1, samples):
        field = H[i, 0]
        dH = field - H[i - 1, 0]
        if not shared or dH != 0.0:
            if shared:
                ahead = extrapolated(dH, last)
                last = dH
            else:
                for g in range(groups):
                    for j in range(LANES):
                        s[g * GROUP + NEXT + j] = H[i, min(g * LANES + j, swarm - 1)]
            for g in range(groups):
                for j in range(LANES):
                    o = g * GROUP + j
                    if not shared:
                        field = s[o + NEXT]
                        dH = field - s[o + FIELD]
                        ahead = extrapolated(dH, s[o + LAST])
                    Mi, D_, M_ = advanced(
                        field, abs(dH), math.copysign(1.0, dH), ahead,
                        s[o + ALPHA], s[o + INVERSE_A], s[o + PULL], s[o + K], s[o + M_S], s[o + C],
                        s[o + MI], s[o + D], s[o + M], s[o + RISE_D], s[o + RISE_M], clamped,
                    )  # fmt: skip
                    rise_D, rise_M = D_ - s[o + D], M_ - s[o + M]
                    if not shared:
                        moved = dH != 0.0
                        s[o + FIELD] = field
                        s[o + LAST] = dH if moved else s[o + LAST]
                        Mi = Mi if moved else s[o + MI]
                        D_ = D_ if moved else s[o + D]
                        M_ = M_ if moved else s[o + M]
                        rise_D = rise_D if moved else s[o + RISE_D]
                        rise_M = rise_M if moved else s[o + RISE_M]
                    s[o + MI] = Mi
                    s[o + D] = D_
                    s[o + M] = M_
                    s[o + RISE_D] = rise_D
                    s[o + RISE_M] = rise_M
        for g in range(groups):
            for j in range(LANES):
                o = g * GROUP + j
                output[i * swarm + g * LANES + j] = MU0 * ((field if shared else s[o + FIELD]) + s[o + M])
    return output[: samples * swarm].reshape(samples, swarm)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _shared(H: Array, alpha: Array, a: Array, k: Array, M_s: Array, c: Array) -> Array:
    return _simulated(H, alpha, a, k, M_s, c, False, True)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _shared_clamped(H: Array, alpha: Array, a: Array, k: Array, M_s: Array, c: Array) -> Array:
    return _simulated(H, alpha, a, k, M_s, c, True, True)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _own(H: Array, alpha: Array, a: Array, k: Array, M_s: Array, c: Array) -> Array:
    return _simulated(H, alpha, a, k, M_s, c, False, False)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _own_clamped(H: Array, alpha: Array, a: Array, k: Array, M_s: Array, c: Array) -> Array:
    return _simulated(H, alpha, a, k, M_s, c, True, False)


def jiles_atherton(H: Array, alpha: Array, a: Array, k: Array, M_s: Array, c: Array, clamped: bool = False) -> Array:
    """B = mu0 (H + M) of a swarm; the module says how.

    H : float64[samples, 1] shared by the swarm, or float64[samples, swarm]; any start, M_irr = 0 there
    alpha : float64[swarm]     interaction, unit of H over unit of M, >= 0
    a : float64[swarm]         form factor, unit of H, > 0
    k : float64[swarm]         pinning loss, unit of H, > 0
    M_s : float64[swarm]       saturation magnetization, > 0
    c : float64[swarm]         reversibility, >= 0
    clamped : dM_irr/dH = 0 while (M_an - M_irr) delta < 0
    -> float64[samples, swarm], C order

    A sample that repeats the field changes nothing. Every particle is computed by the same
    instructions, so that its result depends neither on its place nor on its neighbours.
    """
    kernels = (_shared, _shared_clamped) if H.shape[1] == 1 else (_own, _own_clamped)
    return kernels[clamped](np.ascontiguousarray(H), alpha, a, k, M_s, c)

"""Homogenized free-energy magnetization: play operators under an analytic interaction field.

[1] R. C. Smith, Smart Material Systems: Model Development, SIAM 2005, ch. 4; printed as eqs. (1)-(3) in
Chang G., Zhang Y., Parameter Identification of GMA Nonlinear Dynamics Model Based on ICPSO.

A relay with coercive field H_c and interaction field H_I goes up where H + H_I >= H_c and down where
H + H_I <= -H_c. So the relays of one H_c that are up are those with H_I > -P, and P follows the play
operator of H with radius H_c. The integral over H_I, whose density is even, is then a normal
distribution function of P, and one quadrature over ln H_c remains.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.play import played

Rule = Literal["trapezoid", "gauss-legendre", "gauss-hermite"]

LANES = 8
"""Nodes are handled in groups of this many: one AVX-512 register of float64, two of AVX2."""


def quadrature(rule: Rule, nodes: int, span: float) -> tuple[Array, Array]:
    """Offsets s_j, rising, and weights v_j with sum_j v_j f(s_j) ~ (1/sqrt(pi)) int exp(-s^2) f(s) ds.

    span : half-width of the interval kept by the trapezoid and by Gauss-Legendre
    -> two float64[nodes], the weights normalised to 1. Raises ValueError for an unknown rule.
    """
    if rule == "trapezoid":
        offsets = np.linspace(-span, span, nodes)
        weights = np.exp(-(offsets**2))
        weights[[0, -1]] *= 0.5
    elif rule == "gauss-legendre":
        offsets, weights = np.polynomial.legendre.leggauss(nodes)
        offsets = span * offsets
        weights = weights * np.exp(-(offsets**2))
    elif rule == "gauss-hermite":
        offsets, weights = np.polynomial.hermite.hermgauss(nodes)
    else:
        raise ValueError(f'no rule "{rule}"; known: trapezoid, gauss-legendre, gauss-hermite')
    return offsets, weights / weights.sum()


@njit(cache=True, error_model="numpy", fastmath={"contract"}, inline="always")
def error_function(x: float) -> float:
    """erf(x) by a rational function, without a branch, so that loops over it vectorise.

    Least-maximum fit x N(x^2) / D(x^2) on |x| <= 4.4, clamped beyond; absolute error below 3e-9.
    """
    x = x if x < 4.4 else 4.4
    x = x if x > -4.4 else -4.4
    z = x * x
    numerator = 0.00042872207343089 + z * 7.4597303979056e-06
    numerator = 0.056131953687061 + z * (0.0042778274027632 + z * numerator)
    numerator = 1.1283791948275 + z * (0.19291603896719 + z * numerator)
    denominator = 0.0014542258102448 + z * (7.7415969805583e-05 + z * 2.97040185718e-07)
    denominator = 0.11784434053391 + z * (0.016455405667715 + z * denominator)
    denominator = 1.0 + z * (0.50430109901229 + z * denominator)
    return x * numerator / denominator


@njit(inline="always", error_model="numpy")
def radii(scale, coercive_field, spread, offsets, radius):  # type: ignore[no-untyped-def]
    """Half-widths of the plays times `scale`, rising; the padding at the end of `radius` repeats the last."""
    for j in range(radius.size):
        # the density of H_c in (1), substituted ln(H_c / mean) = 2 c (c + s), is exp(-s^2)
        offset = offsets[min(j, offsets.size - 1)]
        radius[j] = scale * coercive_field * math.exp(2.0 * spread * (spread + offset))


@njit(inline="always", error_model="numpy")
def moving(h, state, radius):  # type: ignore[no-untyped-def]
    """How many plays the field h moves, in groups of LANES.

    A play is 1-Lipschitz in its radius, so the ones that move are the ones of smallest radius.
    """
    moved = 0
    while moved < state.size and abs(h - state[moved]) > radius[moved]:
        moved += LANES
    return moved


@njit(cache=True, error_model="numpy", fastmath={"contract", "reassoc"})
def magnetization(
    field: Array,
    slope: Array,
    amplitude: Array,
    coercive_field: Array,
    spread: Array,
    interaction: Array,
    offsets: Array,
    weights: Array,
) -> Array:
    """Eqs. (1)-(3) of [1]: M = slope H + amplitude sum_j v_j erf(P_j / (b sqrt 2)).

    Demagnetized before the first sample: every play rests at P = 0 and is switched by the first field.

    field : float64[samples, 1] or float64[samples, swarm]    A/m
    slope : float64[swarm]            dM/dH of every kernel, times the mass of the densities
    amplitude : float64[swarm]        A/m, remanence of the kernel times the mass of the densities
    coercive_field : float64[swarm]   A/m, > 0, the mean H_c of (1)
    spread : float64[swarm]           > 0, the c of (1)
    interaction : float64[swarm]      A/m, > 0, the b of (1)
    offsets, weights : float64[nodes] of `quadrature`, rising
    -> float64[samples, swarm]        A/m
    """
    samples, swarm = field.shape[0], slope.size
    nodes = offsets.size
    padded = -(-nodes // LANES) * LANES
    radius = np.empty(padded)
    weight = np.zeros(padded)
    for node in range(nodes):
        weight[node] = weights[node]
    state = np.empty(padded)
    term = np.empty(padded)
    magnetized = np.empty((samples, swarm))
    for i in range(swarm):
        scale = 1.0 / (interaction[i] * math.sqrt(2.0))
        radii(scale, coercive_field[i], spread[i], offsets, radius)
        state[:] = 0.0
        term[:] = 0.0
        column = i if field.shape[1] > 1 else 0
        switched = 0.0
        for k in range(samples):
            h = scale * field[k, column]
            moved = moving(h, state, radius)
            if moved > 0:
                for j in range(moved):
                    p = played(h, radius[j], state[j])  # (3)
                    state[j] = p
                    term[j] = weight[j] * error_function(p)
                switched = 0.0
                for j in range(padded):
                    switched += term[j]
            magnetized[k, i] = slope[i] * field[k, column] + amplitude[i] * switched
    return magnetized

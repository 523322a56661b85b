"""Dahl's friction of a swarm, with a clearance in series: exact on every increment of the displacement.

With w = |du| along an increment, s its direction, z the force as a share of Coulomb's and Q = 1 - s z, equation (3)
of [1], dF/dx = sigma |1 - s F / F_C|^i, is dQ/dw = -Q^i / distance with distance = F_C / sigma, whence

    Q^(1-i) falls by (1 - i) w / distance,    or Q = Q0 exp(-w / distance) for i = 1.

On its way from one sign to the other the force stays 0 while the clearance is crossed.

[1] P. R. Dahl, A solid friction model, Aerospace Corporation, TOR-158(3107-18) (1968).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

EVEN = 1e-6
"""Distance of the exponent from 1 within which it counts as 1."""


@njit(cache=True, error_model="numpy")
def _left(Q: float, width: float, exponent: float) -> float:
    """Q after an increment of this width, in distances."""
    if abs(exponent - 1.0) < EVEN:
        return Q * math.exp(-width)
    power = 1.0 - exponent
    if Q <= 0.0:
        return 0.0
    base = Q**power - power * width
    return base ** (1.0 / power) if base > 0.0 else 0.0


@njit(cache=True, error_model="numpy")
def _width_to_0(Q: float, exponent: float) -> float:
    """The increment, in distances, after which a force against the motion is gone: Q falls to 1."""
    if abs(exponent - 1.0) < EVEN:
        return math.log(Q)
    return (Q ** (1.0 - exponent) - 1.0) / (1.0 - exponent)


@njit(cache=True, error_model="numpy")
def slipped(z: float, place: float, step: float, distance: float, exponent: float, gap: float) -> tuple[float, float]:
    """Force and place in the clearance after the displacement has gone on by `step`.

    z : force over Coulomb's, -1 to 1;  place : -gap to gap, at the edge of its sign where z is not 0
    """
    if step == 0.0:
        return z, place
    s = math.copysign(1.0, step)
    width = abs(step)
    g = s * z
    if g < 0.0:
        until = _width_to_0(1.0 - g, exponent) * distance
        if width < until:
            return s * min(1.0 - _left(1.0 - g, width / distance, exponent), 0.0), place
        width -= until
        g = 0.0
        place = -s * gap
    if g == 0.0:
        room = gap - s * place
        if width <= room:
            return 0.0, place + s * width
        width -= room
    return s * (1.0 - _left(1.0 - g, width / distance, exponent)), s * gap


@njit(cache=True, error_model="numpy")
def dahl(u: Array, distance: Array, exponent: Array, gap: Array) -> Array:
    """Dahl's friction as a share of Coulomb's.

    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    distance : float64[swarm]     over which the force builds up, F_C / sigma, unit of u, > 0
    exponent : float64[swarm]     i >= 0; below 1 the force gets to Coulomb's after a finite way
    gap : float64[swarm]          half the clearance, unit of u, >= 0
    -> float64[samples, swarm]    -1 to 1, 0 at the first sample, in the middle of the clearance
    """
    samples, columns = u.shape
    swarm = distance.size
    out = np.empty((samples, swarm))
    for j in range(swarm):
        column = j if columns > 1 else 0
        z = 0.0
        place = 0.0
        out[0, j] = 0.0
        for i in range(1, samples):
            step = u[i, column] - u[i - 1, column]
            z, place = slipped(z, place, step, distance[j], exponent[j], gap[j])
            out[i, j] = z
    return out

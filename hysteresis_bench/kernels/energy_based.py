"""Energy-based hysteresis of a swarm: cells with dry friction in the field, behind a mean field.

Every cell has the anhysteretic curve of its reversible field, which follows the acting field as a play with the cell's
pinning as half-width; the acting field is the input and what the mean magnetization adds,

    h = u + 3 a coupling m,    m = sum of shares_k L(P_k[h] / a),    L the Langevin function.

For coupling < 1 the second equation has one solution m for every state of the plays: Newton's method, whose slope
is kept away from 1, from the solution before.

[1] A. Bergqvist, Physica B 233 (1997) 342.
[2] F. Henrotte, A. Nicolet, K. Hameyer, COMPEL 25 (2006) 71.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.langevin import langevin_ratio
from hysteresis_bench.kernels.play import played

CLOSE = 1e-12
"""Change of m at which it counts as found."""
MOST_STEPS = 60
STEEPEST = 0.95
"""Slope of the right side in m beyond which a step is no longer lengthened."""


@njit(cache=True, error_model="numpy", fastmath={"contract", "reassoc"})
def _mean(h: float, inverse_a: float, cells: Array, pinning: Array, shares: Array) -> tuple[float, float]:
    """m, and its slope in h, for an acting field h; cells : where the plays are."""
    m = 0.0
    slope = 0.0
    for k in range(shares.size):
        place = played(h, pinning[k], cells[k])
        x = place * inverse_a
        ratio = langevin_ratio(x)
        L = x * ratio
        m += shares[k] * L
        rise = shares[k] * (1.0 - L * L - 2.0 * ratio)
        slope += rise if place != cells[k] else 0.0
    return m, slope * inverse_a


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def energy_based(u: Array, a: Array, coupling: Array, pinning: Array, shares: Array) -> Array:
    """The mean magnetization over saturation.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    a : float64[swarm]                  form factor of the anhysteretic curve, unit of u, > 0
    coupling : float64[swarm]           mean field over what makes the curve upright, 0 to below 1
    pinning : float64[cells, swarm]     unit of u, >= 0
    shares : float64[cells, swarm]      of the cells, >= 0, sum 1
    -> float64[samples, swarm]          -1 to 1; on the anhysteretic curve at the first sample
    """
    samples, columns = u.shape
    count, swarm = shares.shape
    out = np.empty((samples, swarm))
    for j in range(swarm):
        column = j if columns > 1 else 0
        own_pinning, own_shares = pinning[:, j].copy(), shares[:, j].copy()
        cells = np.zeros(count)
        free = np.zeros(count)
        field, inverse_a = 3.0 * a[j] * coupling[j], 1.0 / a[j]
        m = 0.0
        for i in range(samples):
            now = u[i, column]
            widths = own_pinning if i > 0 else free
            for _ in range(MOST_STEPS):
                found, slope = _mean(now + field * m, inverse_a, cells, widths, own_shares)
                change = (found - m) / (1.0 - min(field * slope, STEEPEST))
                m = min(max(m + change, -1.0), 1.0)
                if abs(change) <= CLOSE:
                    break
            h = now + field * m
            for k in range(count):
                cells[k] = played(h, widths[k], cells[k])
            out[i, j] = m
    return out

"""One increment of a joint that slips in holes it has worn, round at every corner.

With x the displacement over u_y, f the force over F_0, both counted in the direction s of an increment, X the largest
displacement from which the force was taken off on the side s, and M that of both sides,

    envelope(x) = (1 + r_1 x) (1 - exp(-x)) for x >= 0                                             [1, eq. (1)],
    way(x) = p(x) + (b(x) + (b(x)² + c²)^(1/2)) / 2 below beta X, envelope(x) from there,
    p(x) = min(f_I g, envelope(beta X) - h beta X) + h x,    h = r_4 / (1 + beta M),    g = max(M, 1)^gamma,
    b(x) = d - c² / 4 d + (1 - h) (x - beta X),    d = envelope(beta X) - p(beta X),    c = min(corner g, 2 d),

so that the way ends on the envelope; the distance of f from it falls exponentially, over rho max(M, 1), after [2]. As
envelope(x) >= x / (1 + x), the ways of both directions leave a loop that runs clockwise for r_4 <= 1; f, once between
them, stays there.

[1] B. Folz, A. Filiatrault, J. Structural Engineering 127 (2001) 1361.
[2] W.-C. Pang, D. V. Rosowsky, S. Pei, J. W. van de Lindt, J. Structural Engineering 133 (2007) 1118.
Ours: the hyperbola between pinched line and way back, their growth with M, and exponential unloading from anywhere.
"""

from __future__ import annotations

import math

from numba import njit

from hysteresis_bench.arrays import Array

YIELD, HARDENING, PINCHED, GROWTH, SLOPE, BEYOND, LENGTH, CORNER = range(8)
"""Rows of the parameters."""


@njit(cache=True, error_model="numpy")
def _envelope(x: float, hardening: float) -> float:
    return (1.0 + hardening * x) * -math.expm1(-x) if x > 0.0 else 0.0


@njit(cache=True, error_model="numpy")
def _way(x: float, own: float, both: float, p: Array) -> float:
    """Where the force leads; own : X;  both : M"""
    end = p[BEYOND] * own
    if x >= end:
        return _envelope(x, p[HARDENING])
    slope = p[SLOPE] / (1.0 + p[BEYOND] * both)
    grown = max(both, 1.0) ** p[GROWTH]
    top = _envelope(end, p[HARDENING]) - slope * end
    low = min(p[PINCHED] * grown, top)
    rise = top - low
    corner = min(p[CORNER] * grown, 2.0 * rise)
    back = (1.0 - slope) * (x - end)
    if rise > 0.0:
        back += rise - 0.25 * corner * corner / rise
    return low + slope * x + 0.5 * (back + math.sqrt(back * back + corner * corner))


@njit(cache=True, error_model="numpy")
def pinched(f: float, old: float, x: float, own: float, other: float, p: Array) -> float:
    """f after an increment from old to x, all in its direction and in u_y.

    own, other : largest reversal of the side to which it goes, and of the other;  p : float64[8], rows as named above
    """
    both = max(own, other)
    left = (_way(old, own, both, p) - f) * math.exp((old - x) / (p[LENGTH] * max(both, 1.0)))
    led = _way(x, own, both, p) - left
    back = -_way(-x, other, max(both, x), p)
    return back if led < back and f >= -_way(-old, other, max(both, old), p) else led

"""One increment of a timber connection: an envelope, pinched lines, and a softer way back from further off.

With x the displacement over u_y = F_0 / S, f the force over F_0, both counted in the direction s of an increment, and
X the largest displacement from which the force was taken off on the side s, of both sides for the pinched line,

    envelope(x) = (1 + r_1 x) (1 - exp(-x)) for x >= 0, odd                                        [1, eq. (1)],
    pinched(x) = f_I + r_4 K x,    back(x) = envelope(beta X) + K (x - beta X),    K = X^-alpha    [1, eq. (2)],

f rises by r_3 along x until it meets the larger of the pinched line and the way back, which leads to the envelope.

[1] B. Folz, A. Filiatrault, J. Structural Engineering 127 (2001) 1361.
Ours: the envelope has no peak, the pinched line softens as the way back does, and X is the largest displacement of a
reversal, not the last one.
"""

from __future__ import annotations

import math

from numba import njit

from hysteresis_bench.arrays import Array

YIELD, HARDENING, UNLOADING, PINCHED, SLOPE, SOFTENING, BEYOND = range(7)
"""Rows of the parameters."""


@njit(cache=True, error_model="numpy")
def _envelope(x: float, hardening: float) -> float:
    return (1.0 + hardening * x) * -math.expm1(-x)


@njit(cache=True, error_model="numpy")
def _stiffness(X: float, softening: float) -> float:
    return X**-softening if X > 1.0 else 1.0


@njit(cache=True, error_model="numpy")
def followed(f: float, x: float, width: float, own: float, largest: float, p: Array) -> float:
    """f after an increment of this width that ends at x, all in its direction and in u_y.

    own, largest : X of the side to which it goes, and of both;  p : float64[7], rows as named above
    """
    end = p[BEYOND] * own
    if x >= end:
        way = _envelope(x, p[HARDENING])
    else:
        back = _envelope(end, p[HARDENING]) + _stiffness(own, p[SOFTENING]) * (x - end)
        way = p[PINCHED] + p[SLOPE] * _stiffness(largest, p[SOFTENING]) * x
        way = max(way, min(back, _envelope(max(x, 0.0), p[HARDENING])))
    return min(f + p[UNLOADING] * width, max(way, f))

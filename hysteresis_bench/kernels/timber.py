"""Hysteresis of a swarm of timber connections: `timber_step` has the law and the step of one particle.

Here LANES particles make that step side by side. What the way back and the pinched line take from X stays from a
reversal to the next that goes further, so that an increment takes one exponential, the envelope's.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import exponential, exponential_less_1, logarithm
from hysteresis_bench.kernels.reversals import (
    EXTREME,
    LANES,
    LAW,
    NEW,
    OTHER,
    OWN,
    SENSE,
    TOWARD,
    YIELD,
    X,
    begun,
    given,
    reaching,
    swapped,
    turned_round,
    turning,
)

# Rows of a group after those of reversals: the parameters but u_y, f, the slope of the pinched line, then K and the
# envelope at beta X of the side to which it goes, and of the other.
HARDENING, UNLOADING, PINCHED, SLOPE, SOFTENING, BEYOND = (row * LANES for row in range(LAW, LAW + 6))
F, FLAT, K, TOP, OTHER_K, OTHER_TOP = (row * LANES for row in range(LAW + 6, LAW + 12))
ROWS = LAW + 12


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _envelope(x, hardening):  # type: ignore[no-untyped-def]
    return (1.0 + hardening * x) * -exponential_less_1(-x)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _stiffness(reached, softening):  # type: ignore[no-untyped-def]
    return exponential(-softening * logarithm(max(reached, 1.0)))


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _turned(s):  # type: ignore[no-untyped-def]
    """The sides of the lanes that turn round."""
    for j in range(min(LANES, s.size)):
        turned = s[TOWARD + j] != s[SENSE + j]
        swapped(s, j, K, OTHER_K, turned, 1.0)
        swapped(s, j, TOP, OTHER_TOP, turned, 1.0)
        turned_round(s, j, turned)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _softened(s):  # type: ignore[no-untyped-def]
    """What is taken from X anew where a reversal went further."""
    for j in range(min(LANES, s.size)):
        extreme, softening = s[EXTREME + j], s[SOFTENING + j]
        further = extreme > 0.0
        flat = s[SLOPE + j] * _stiffness(max(extreme, s[OWN + j]), softening)
        top = _envelope(s[BEYOND + j] * extreme, s[HARDENING + j])
        s[FLAT + j] = flat if further else s[FLAT + j]
        s[OTHER + j], s[OTHER_TOP + j] = extreme if further else s[OTHER + j], top if further else s[OTHER_TOP + j]
        s[OTHER_K + j] = _stiffness(extreme, softening) if further else s[OTHER_K + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(s):  # type: ignore[no-untyped-def]
    """One increment of every lane."""
    for j in range(min(LANES, s.size)):
        toward, old, new = s[TOWARD + j], s[X + j], s[NEW + j]
        x, f, end = toward * new, toward * s[F + j], s[BEYOND + j] * s[OWN + j]
        envelope = _envelope(max(x, 0.0), s[HARDENING + j])
        back = min(s[TOP + j] + s[K + j] * (x - end), envelope)
        way = envelope if x >= end else max(s[PINCHED + j] + s[FLAT + j] * x, back)
        width = abs(new - old)
        s[F + j] = toward * min(f + s[UNLOADING + j] * width, max(way, f)) if width > 0.0 else s[F + j]
        s[X + j] = new


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def followed_together(s: Array) -> None:
    """The state of a group after its inputs, counted from the first one, have gone to s[INPUT:]."""
    begun(s)
    if turning(s) > 0:
        _turned(s)
        if reaching(s) > 0:
            _softened(s)
    _advanced(s)


@njit(cache=True, error_model="numpy")
def timber(u: Array, parameters: Array) -> Array:
    """Force over F_0.

    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    parameters : float64[7, swarm]    u_y > 0, unit of u; r_1 >= 0; r_3 > 0; f_I >= 0; r_4 >= 0; alpha; beta >= 1
    -> float64[samples, swarm]        0 at the first sample, from which the displacement counts
    """
    samples = u.shape[0]
    swarm = parameters.shape[1]
    out = np.zeros((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        for j in range(LANES):
            p = parameters[:, first + min(j, used - 1)]
            s[YIELD + j] = p[0]
            for row in range(1, 7):
                s[HARDENING + (row - 1) * LANES + j] = p[row]
            s[FLAT + j] = s[SLOPE + j]
            s[K + j] = s[OTHER_K + j] = 1.0
        for i in range(1, samples):
            given(s, u, i, first, used)
            followed_together(s)
            for j in range(used):
                out[i, first + j] = s[F + j]
    return out

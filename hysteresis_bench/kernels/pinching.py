"""Hysteresis of a swarm of joints that slip in holes they have worn: `pinching_step` has the law and one joint's step.

Here LANES joints make that step side by side. Both ways, the one that the force is led to and the other direction's,
the way back, are what they were until M or X changes, by a reversal further out than any before; the way back changes
also while x is beyond M. A reversal further in swaps them. So an increment takes one exponential for the envelope, one
for the distance from it and two square roots.

Where f came along a way and turns round, it starts on the way back: that is told by comparing both, so the value of a
way at the last x is kept and not computed again, which might round it to the other side.
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

# Rows of a group after those of reversals: the parameters but u_y, the state, then of the way and of the way back the
# value at x, the envelope at beta X, h, and what else is constant in them.
HARDENING, PINCHED, GROWTH, SLOPE, BEYOND, LENGTH, CORNER = (row * LANES for row in range(LAW, LAW + 7))
F, RATE = (row * LANES for row in range(LAW + 7, LAW + 9))
WAY, TOP, H, LOW, SHIFT, ROUND = (row * LANES for row in range(LAW + 9, LAW + 15))
BACK, BACK_TOP, BACK_H, BACK_LOW, BACK_SHIFT, BACK_ROUND = (row * LANES for row in range(LAW + 15, LAW + 21))
ROWS = LAW + 21


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _envelope(x, hardening):  # type: ignore[no-untyped-def]
    x = max(x, 0.0)
    return (1.0 + hardening * x) * -exponential_less_1(-x)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _constants(end, top, slope, pinched, corner):  # type: ignore[no-untyped-def]
    """p(0), b(end) and c² of a way that ends at `end` on an envelope of `top`;  pinched, corner : as M made them"""
    top = top - slope * end
    low = min(pinched, top)
    rise = top - low
    size = min(corner, 2.0 * rise)
    return low, (rise - 0.25 * size * size / rise if rise > 0.0 else 0.0), size * size


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _way(x, end, slope, low, shift, size):  # type: ignore[no-untyped-def]
    back = (1.0 - slope) * (x - end) + shift
    return low + slope * x + 0.5 * (back + np.sqrt(back * back + size))


@njit(forceinline=True, error_model="numpy")
def _beyond(s):  # type: ignore[no-untyped-def]
    """How many lanes go further than they were turned on any side."""
    beyond = 0
    for j in range(min(LANES, s.size)):
        beyond += 1 if s[TOWARD + j] * s[NEW + j] > max(s[OWN + j], s[OTHER + j]) else 0
    return beyond


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _turned(s):  # type: ignore[no-untyped-def]
    """The way becomes the way back of the lanes that turn round."""
    for j in range(min(LANES, s.size)):
        turned = s[TOWARD + j] != s[SENSE + j]
        swapped(s, j, WAY, BACK, turned, -1.0)
        swapped(s, j, TOP, BACK_TOP, turned, 1.0)
        swapped(s, j, H, BACK_H, turned, 1.0)
        swapped(s, j, LOW, BACK_LOW, turned, 1.0)
        swapped(s, j, SHIFT, BACK_SHIFT, turned, 1.0)
        swapped(s, j, ROUND, BACK_ROUND, turned, 1.0)
        turned_round(s, j, turned)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _worn(s):  # type: ignore[no-untyped-def]
    """Both ways anew where a reversal went further."""
    for j in range(min(LANES, s.size)):
        extreme, own, top, beyond = s[EXTREME + j], s[OWN + j], s[TOP + j], s[BEYOND + j]
        worn = extreme > 0.0
        both = max(extreme, own)
        large = max(both, 1.0)
        slope, grown = s[SLOPE + j] / (1.0 + beyond * both), exponential(s[GROWTH + j] * logarithm(large))
        pinched, corner = s[PINCHED + j] * grown, s[CORNER + j] * grown
        low, shift, size = _constants(beyond * own, top, slope, pinched, corner)
        way = _way(-extreme, beyond * own, slope, low, shift, size)
        end = beyond * extreme
        top = _envelope(end, s[HARDENING + j])
        back_low, back_shift, back_size = _constants(end, top, slope, pinched, corner)
        on_envelope = extreme >= end  # where BACK is the envelope already
        back = s[BACK + j] if on_envelope else -_way(extreme, end, slope, back_low, back_shift, back_size)
        s[WAY + j], s[BACK + j] = way if worn else s[WAY + j], back if worn else s[BACK + j]
        s[OTHER + j], s[BACK_TOP + j] = extreme if worn else s[OTHER + j], top if worn else s[BACK_TOP + j]
        s[H + j], s[BACK_H + j] = slope if worn else s[H + j], slope if worn else s[BACK_H + j]
        s[LOW + j], s[BACK_LOW + j] = low if worn else s[LOW + j], back_low if worn else s[BACK_LOW + j]
        s[SHIFT + j], s[BACK_SHIFT + j] = shift if worn else s[SHIFT + j], back_shift if worn else s[BACK_SHIFT + j]
        s[ROUND + j], s[BACK_ROUND + j] = size if worn else s[ROUND + j], back_size if worn else s[BACK_ROUND + j]
        s[RATE + j] = 1.0 / (s[LENGTH + j] * large) if worn else s[RATE + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _wearing(s):  # type: ignore[no-untyped-def]
    """The way back anew where x goes further than any reversal."""
    for j in range(min(LANES, s.size)):
        x, beyond = s[TOWARD + j] * s[NEW + j], s[BEYOND + j]
        further = x > max(s[OWN + j], s[OTHER + j])
        large = max(x, 1.0)
        slope, grown = s[SLOPE + j] / (1.0 + beyond * max(x, 0.0)), exponential(s[GROWTH + j] * logarithm(large))
        end = beyond * s[OTHER + j]
        low, shift, size = _constants(end, s[BACK_TOP + j], slope, s[PINCHED + j] * grown, s[CORNER + j] * grown)
        s[BACK_H + j], s[BACK_LOW + j] = slope if further else s[BACK_H + j], low if further else s[BACK_LOW + j]
        s[BACK_SHIFT + j] = shift if further else s[BACK_SHIFT + j]
        s[BACK_ROUND + j] = size if further else s[BACK_ROUND + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(s):  # type: ignore[no-untyped-def]
    """One increment of every lane."""
    for j in range(min(LANES, s.size)):
        toward, old, new = s[TOWARD + j], s[X + j], s[NEW + j]
        x, width = toward * new, abs(new - old)
        f, before, beyond = toward * s[F + j], s[BACK + j], s[BEYOND + j]
        end = beyond * s[OWN + j]
        inside = _way(x, end, s[H + j], s[LOW + j], s[SHIFT + j], s[ROUND + j])
        way = _envelope(x, s[HARDENING + j]) if x >= end else inside
        led = way - (s[WAY + j] - f) * exponential(-width * s[RATE + j])
        end = beyond * s[OTHER + j]
        back = -_way(-x, end, s[BACK_H + j], s[BACK_LOW + j], s[BACK_SHIFT + j], s[BACK_ROUND + j])
        found = back if (led < back) & (f >= before) else led
        moved = width > 0.0
        s[WAY + j], s[BACK + j] = way if moved else s[WAY + j], back if moved else before
        s[F + j] = toward * found if moved else s[F + j]
        s[X + j] = new


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def pinched_together(s: Array) -> None:
    """The state of a group after its inputs, counted from the first one, have gone to s[INPUT:]."""
    begun(s)
    if turning(s) > 0:
        _turned(s)
        if reaching(s) > 0:
            _worn(s)
    if _beyond(s) > 0:
        _wearing(s)
    _advanced(s)


@njit(cache=True, error_model="numpy")
def _grouped(parameters: Array, first: int, used: int) -> Array:
    """A group at rest, the `first` particle to the `used` that follow and copies of the last."""
    s = np.zeros(ROWS * LANES)
    for j in range(LANES):
        p = parameters[:, first + min(j, used - 1)]
        s[YIELD + j] = p[0]
        for row in range(1, 8):
            s[HARDENING + (row - 1) * LANES + j] = p[row]
        s[H + j] = s[BACK_H + j] = s[SLOPE + j]
        s[RATE + j] = 1.0 / s[LENGTH + j]
    return s


@njit(cache=True, error_model="numpy")
def pinching(u: Array, parameters: Array) -> Array:
    """Force over F_0.

    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    parameters : float64[8, swarm]    u_y > 0, unit of u; r_1 >= 0; f_I >= 0; gamma; 0 <= r_4 <= 1; beta >= 1; rho > 0;
                                      corner >= 0
    -> float64[samples, swarm]        0 at the first sample, from which the displacement counts
    """
    samples = u.shape[0]
    swarm = parameters.shape[1]
    out = np.zeros((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = _grouped(parameters, first, used)
        for i in range(1, samples):
            given(s, u, i, first, used)
            pinched_together(s)
            for j in range(used):
                out[i, first + j] = s[F + j]
    return out

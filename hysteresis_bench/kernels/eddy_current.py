"""Eddy currents inside a hysteresis law: what acts is the input less a drag on the rate of the output.

[1] G. Bertotti, Hysteresis in Magnetism, Academic Press (1998), ch. 12: classical eddy currents in a lamination
    oppose the applied field in proportion to the rate of the induction.
[2] D. C. Jiles, Modelling the effects of eddy current losses on frequency dependent hysteresis in electrically
    conducting media, IEEE Trans. Magnetics 30 (1994) 4326.
[3] W. Liniger, R. A. Willoughby, Efficient integration methods for stiff systems of ordinary differential
    equations, SIAM J. Numer. Anal. 7 (1970) 47: exponential fitting of the theta method.
[4] N. Anderson, A. Bjorck, A new high order method of regula falsi type, BIT 13 (1973) 253.

With u the input, z what acts, y = F[z] the hysteresis law and e the coefficient,

    z = u - e dy/dt.

Over one sample of duration h the mean of both sides is taken with a weight theta on its end:

    theta (z_i - u_i) + (1 - theta) (z_j - u_j) + (e / h) (F(z_i) - y_j) = 0,    j = i - 1.

theta is such that a law of constant slope, which makes this a first-order lag of e times the slope, is exact for
an input that is linear between its samples [3]. It goes from 1/2, second order, where that lag is longer than h, to
1 where it is shorter, so that nothing rings. The left side grows with z_i along the one branch of the law that leaves
z_j: one root, always bracketed, found without a derivative [4].
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from numba import njit

TOLERANCE = 1e-12
"""The equation is solved to this share of its value before the step."""
ROUNDING = 4e-16
"""A bracket narrower than this share of the numbers in it has nothing between its ends."""
MOST = 100
"""Trials of one step; half a dozen are usual."""


@njit(cache=True, error_model="numpy")
def end_weight(x: float) -> float:
    """theta = 1 / (1 - exp(-x)) - 1 / x, from 1/2 at x = 0 to 1 at infinity; x : step over time constant."""
    if x < 1e-2:
        return 0.5 + x * (1.0 / 12.0 - x * x / 720.0)
    return -1.0 / math.expm1(-x) - 1.0 / x


# Inlined: a kernel that passed its law to a function of its own could not be cached.
@njit(error_model="numpy", inline="always")
def acting(
    law: Callable[[Any, float], float], state: Any, z: float, y: float, u: float, new: float, rate: float
) -> tuple[float, float]:
    """One sample on: what acts at its end, and the output.

    law(state, z) : the output where the acting input has moved on to z; leaves what it found in `state`, as a
        trial: the last call made is at the answer
    z, y, u : acting input, output and input at the sample before
    new : input at this sample
    rate : e over the duration of the step, >= 0, unit of u over unit of y

    The answer stays between z and the inputs. Ours: where the law moves against its input, which no induction
    does, there is no drag.
    """
    lead = new - z
    slope = (law(state, new) - y) / lead if lead != 0.0 else 0.0
    theta = end_weight(1.0 / (rate * slope)) if rate * slope > 0.0 else 1.0
    behind = z - u
    undragged = new - (1.0 - theta) / theta * behind
    undragged = min(max(undragged, min(u, new)), max(u, new))
    along = 1.0 if undragged > z else -1.0

    # way : distance from z; below, above : what the equation's left side is at either end of the bracket
    low, below = 0.0, -abs(behind - theta * (new - u))
    way = high = abs(undragged - z)
    answer = z + along * way
    output = law(state, answer)
    above = below + theta * way + rate * max(along * (output - y), 0.0)
    if above <= 0.0:
        return answer, output
    enough = TOLERANCE * abs(below)
    last = 0
    for _ in range(MOST):
        way = low - below * (high - low) / (above - below)
        answer = z + along * way
        output = law(state, answer)
        value = theta * way - abs(behind - theta * (new - u)) + rate * max(along * (output - y), 0.0)
        if abs(value) <= enough or high - low <= ROUNDING * (abs(z) + high):
            break
        # regula falsi; an end that stays twice is weighted down [4]
        if value < 0.0:
            kept = 1.0 - value / below
            above *= (kept if kept > 0.0 else 0.5) if last < 0 else 1.0
            low, below, last = way, value, -1
        else:
            kept = 1.0 - value / above
            below *= (kept if kept > 0.0 else 0.5) if last > 0 else 1.0
            high, above, last = way, value, 1
    return answer, output

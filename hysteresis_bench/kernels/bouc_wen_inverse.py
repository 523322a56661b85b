"""The inverse of the Bouc-Wen kernel: the input that makes the discrete model put out what is wanted.

With w = |du|, s its direction and g = s h as in `bouc_wen`, an increment moves v by s F(w),

    F(w) = d w - (g(w) - g(0)),   dF/dw = d - dg/dw,

and where v(u) is monotonic F rises from 0 without bound: the sign of the wanted change is the direction, and one
root gives the increment. F uses the forward kernel's own increment, the crossing of h = 0 included, so that
nothing is approximated and nothing drifts: every sample aims at v itself, not at its change.

The forward kernel cuts rates at STEEPEST; here they are not. The two differ where (gamma - beta) |du| exceeds it.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import _integrated, _regrown, _slope, _weakened

MOST_STEPS = 200
"""Newton steps, or halvings of the bracket, of one sample; 3 to 6 are usual."""


@njit(cache=True, error_model="numpy")
def _grown(g: float, drive: float, along: float, against: float, n: float, width: float) -> float:
    """g = s h after an increment: the forward kernels' step."""
    if width == 0.0:
        return g
    if n != 1.0:
        return _integrated(g, drive, along, against, n, width, np.inf)
    rate = against if g < 0.0 else along
    free = g + (drive - rate * g) * _weakened(rate, width)
    if g < 0.0 and free > 0.0:
        return _regrown(g, drive, along, against, width)
    return free


@njit(cache=True, error_model="numpy")
def moved(u: float, h: float, to: float, alpha: float, beta: float, gamma: float, d: float, n: float) -> float:
    """h after the input has gone from u to `to`; arguments as in `inverted`."""
    direction = 1.0 if to >= u else -1.0
    return direction * _grown(direction * h, alpha * d, beta + gamma, beta - gamma, n, abs(to - u))


@njit(cache=True, error_model="numpy")
def inverted(
    u: float, h: float, v: float, alpha: float, beta: float, gamma: float, d: float, n: float
) -> tuple[float, float]:
    """The next input and h, so that the output is v: Newton's method, kept inside a bracket.

    u, h : where the model is;  v : output wanted, unit of d u
    alpha, beta, gamma, d, n : as in `bouc_wen_power`; d > 0, alpha >= 0, beta + gamma > 0 and
        alpha max(1, 2 beta / (beta + gamma)) < 1, else there need not be an inverse
    """
    drive, along, against = alpha * d, beta + gamma, beta - gamma
    change = v - (d * u - h)
    direction = 1.0 if change >= 0.0 else -1.0
    rise, start = abs(change), direction * h
    close = (1e-16 if n == 1.0 else 1e-14) * (abs(v) + abs(d * u) + abs(h))
    low, high = 0.0, np.inf
    width = rise / (d - _slope(start, drive, along, against, n))
    for _ in range(MOST_STEPS):
        g = _grown(start, drive, along, against, n, width)
        beyond = d * width - (g - start) - rise
        if abs(beyond) <= close:
            break
        if beyond > 0.0:
            high = width
        else:
            low = width
        newton = width - beyond / (d - _slope(g, drive, along, against, n))
        if not low < newton < high:
            newton = 2.0 * low if high == np.inf else 0.5 * (low + high)
        if newton in (low, high, width):
            break
        width = newton
    to = u + direction * width
    return to, moved(u, h, to, alpha, beta, gamma, d, n)


@njit(cache=True, error_model="numpy")
def invert(v: Array, alpha: float, beta: float, gamma: float, d: float, n: float) -> Array:
    """The input whose Bouc-Wen output is v; like the forward kernel it begins with h = 0, so u(0) = v(0) / d.

    v : float64[samples], unit of d u;  parameters as in `inverted`
    -> float64[samples]    u
    """
    u = np.empty(v.size)
    u[0] = v[0] / d
    h = 0.0
    for i in range(1, v.size):
        u[i], h = inverted(u[i - 1], h, v[i], alpha, beta, gamma, d, n)
    return u

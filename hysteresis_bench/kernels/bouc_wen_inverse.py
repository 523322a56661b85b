"""The inverse of the Bouc-Wen kernel: the input that makes the discrete model put out what is wanted.

With w = |du|, s its direction and g = s h as in `bouc_wen`, an increment moves v by s F(w),

    F(w) = d w - (g(w) - g(0)),   dF/dw = d - dg/dw,

and where v(u) is monotonic F rises from 0 without bound: the sign of the wanted change is the direction, and one
root gives the increment. F uses the forward kernel's own increment, the crossing of h = 0 included, so that
nothing is approximated and nothing drifts: every sample aims at v itself, not at its change.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen_step import grown, moved, slope

MOST_STEPS = 200
"""Newton steps, or halvings of the bracket, of one sample; 3 to 6 are usual."""


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
    width = rise / (d - slope(start, drive, along, against, n))
    for _ in range(MOST_STEPS):
        g = grown(start, drive, along, against, n, width, np.inf)
        beyond = d * width - (g - start) - rise
        if abs(beyond) <= close:
            break
        if beyond > 0.0:
            high = width
        else:
            low = width
        newton = width - beyond / (d - slope(g, drive, along, against, n))
        if not low < newton < high:
            newton = 2.0 * low if high == np.inf else 0.5 * (low + high)
        if newton in (low, high, width):
            break
        width = newton
    to = u + direction * width
    return to, moved(h, to - u, drive, beta, gamma, n, np.inf)


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

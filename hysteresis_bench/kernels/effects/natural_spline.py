"""Natural cubic splines of a swarm: one abscissa or one a column, ordinates that differ from column to column."""

from __future__ import annotations

from functools import cache

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@cache
def bending(knots: tuple[float, ...]) -> Array:
    """The matrix (knots, knots) that makes second derivatives of ordinates at the knots, 0 at both ends [1].

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """
    h = np.diff(np.array(knots))
    count = h.size + 1
    left, right = np.eye(count), np.zeros((count, count))
    for k in range(1, count - 1):
        left[k, k - 1 : k + 2] = h[k - 1] / 6.0, (h[k - 1] + h[k]) / 3.0, h[k] / 6.0
        right[k, k - 1 : k + 2] = 1.0 / h[k - 1], -1.0 / h[k - 1] - 1.0 / h[k], 1.0 / h[k]
    matrix: Array = np.linalg.solve(left, right)
    return matrix


def natural_spline(
    x: Array, low: Array, high: Array, *, knots: tuple[float, ...], ordinates: Array, held: bool = False
) -> Array:
    """The natural cubic spline through ordinates at knots, straight beyond the outer ones, or level where `held`.

    x : float64[samples, 1] or float64[samples, swarm]    any unit
    low, high : float64[swarm]                            unit of x, where the knots 0 and 1 lie
    knots : from 0 to 1, rising
    ordinates : float64[knots, swarm]                     any unit; all 0: exactly 0
    -> float64[samples, swarm]                            unit of the ordinates
    """
    bends = bending(knots) @ ordinates
    found: Array = _evaluated(x, low, 1.0 / (high - low), np.array(knots), np.ascontiguousarray(ordinates), bends, held)
    return found


@njit(cache=True, error_model="numpy")
def _evaluated(x, low, scale, knots, ordinates, bends, held):  # type: ignore[no-untyped-def]
    samples, columns = x.shape
    count, swarm = ordinates.shape
    out = np.empty((samples, swarm))
    for i in range(samples):
        for j in range(swarm):
            z = ((x[i, j] if columns > 1 else x[i, 0]) - low[j]) * scale[j]
            if held:
                z = min(max(z, 0.0), 1.0)
            if z < 0.0:
                h = knots[1]
                slope = (ordinates[1, j] - ordinates[0, j]) / h - h / 6.0 * bends[1, j]
                out[i, j] = ordinates[0, j] + slope * z
            elif z > 1.0:
                h = 1.0 - knots[count - 2]
                slope = (ordinates[count - 1, j] - ordinates[count - 2, j]) / h + h / 6.0 * bends[count - 2, j]
                out[i, j] = ordinates[count - 1, j] + slope * (z - 1.0)
            else:
                k = 0
                while k < count - 2 and z > knots[k + 1]:
                    k += 1
                h = knots[k + 1] - knots[k]
                b = (z - knots[k]) / h
                a = 1.0 - b
                out[i, j] = (
                    a * ordinates[k, j]
                    + b * ordinates[k + 1, j]
                    + ((a * a * a - a) * bends[k, j] + (b * b * b - b) * bends[k + 1, j]) * (h * h / 6.0)
                )
    return out

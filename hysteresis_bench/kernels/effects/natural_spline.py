"""Natural cubic splines of a swarm: one abscissa or one a column, ordinates that differ from column to column."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


class Curves(NamedTuple):
    """A natural cubic spline a column, straight beyond the outer knots, or level.

    low, scale : float64[swarm]              where knot 0 lies, and 1 / the distance of knot 1 from it
    extremes : float64[4]                    least and largest low, least and largest scale
    knots : float64[knots]                   from 0 to 1, rising
    pieces : float64[knots + 1, 4, swarm]    coefficients of the powers 0 to 3 of the distance from the knot before; of
                                             the first piece, which has none before it, from knot 0
    """

    low: Array
    scale: Array
    extremes: Array
    knots: Array
    pieces: Array


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


def natural_splines(low: Array, high: Array, *, knots: tuple[float, ...], ordinates: Array, held: bool) -> Curves:
    """The natural cubic splines through ordinates at knots, straight beyond the outer ones, or level where `held`.

    low, high : float64[swarm]              unit of the abscissa, where the knots 0 and 1 lie
    ordinates : float64[knots, swarm]       any unit; all 0: exactly 0
    """
    h = np.diff(np.array(knots))[:, None]
    bends = bending(knots) @ ordinates
    pieces = np.zeros((len(knots) + 1, 4, ordinates.shape[1]))
    pieces[0, 0], pieces[1:, 0] = ordinates[0], ordinates
    inner = pieces[1:-1]
    inner[:, 1] = np.diff(ordinates, axis=0) / h - h / 6.0 * (2.0 * bends[:-1] + bends[1:])
    inner[:, 2] = 0.5 * bends[:-1]
    inner[:, 3] = np.diff(bends, axis=0) / (6.0 * h)
    if not held:
        pieces[0, 1] = inner[0, 1]
        pieces[-1, 1] = (ordinates[-1] - ordinates[-2]) / h[-1] + h[-1] / 6.0 * bends[-2]
    scale = 1.0 / (high - low)
    extremes = np.array([np.min(low), np.max(low), np.min(scale), np.max(scale)])
    return Curves(low, scale, extremes, np.array(knots), pieces)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _cubic(pieces, k, j, z):  # type: ignore[no-untyped-def]
    return pieces[k, 0, j] + z * (pieces[k, 1, j] + z * (pieces[k, 2, j] + z * pieces[k, 3, j]))


@njit(forceinline=True, error_model="numpy")
def _piece(knots, z):  # type: ignore[no-untyped-def]
    """In which z lies: how many knots are below it."""
    k = 0
    while k < knots.size and z > knots[k]:
        k += 1
    return k


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def splines_at(x, low, scale, extremes, knots, pieces, out):  # type: ignore[no-untyped-def]
    """All curves at one abscissa, into out, float64[swarm]; the others as in `Curves`."""
    nearest, furthest = x - extremes[1], x - extremes[0]
    first = _piece(knots, nearest * (extremes[2] if nearest > 0.0 else extremes[3]))
    last = _piece(knots, furthest * (extremes[3] if furthest > 0.0 else extremes[2]))
    origin = knots[max(first - 1, 0)]
    for j in range(out.size):  # mostly one piece for all, so that columns go side by side
        out[j] = _cubic(pieces, first, j, (x - low[j]) * scale[j] - origin)
    for k in range(first + 1, last + 1):
        origin = knots[k - 1]
        for j in range(out.size):
            z = (x - low[j]) * scale[j] - origin
            out[j] = _cubic(pieces, k, j, z) if z > 0.0 else out[j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def add_spline_of_own(y: Array, x: Array, curves: Curves) -> None:
    """y + s(x) in place of y, of an abscissa each; x : float64[samples, swarm], may be y

    Indices that cannot be negative let loops over columns be vectorised.
    """
    low, scale, _, knots, pieces = curves
    samples, swarm = x.shape
    origins = np.append(knots[:1], knots)
    place, piece, one = np.empty(swarm), np.empty(swarm, dtype=np.uint64), np.uint64(1)
    for i in range(samples):
        for j in range(swarm):
            place[j] = (x[i, j] - low[j]) * scale[j]
            piece[j] = 0
        for k in range(knots.size):
            knot = knots[k]
            for j in range(swarm):
                piece[j] += one if place[j] > knot else 0
        for j in range(swarm):
            place[j] = _cubic(pieces, piece[j], j, place[j] - origins[piece[j]])
        for j in range(swarm):
            y[i, j] += place[j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def add_spline(y: Array, x: Array, curves: Curves) -> None:
    """y + s(x) in place of y, float64[samples, swarm];  x : float64[samples]"""
    low, scale, extremes, knots, pieces = curves
    now = np.empty(low.size)
    for i in range(x.size):
        splines_at(x[i], low, scale, extremes, knots, pieces, now)
        for j in range(now.size):
            y[i, j] += now[j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def scale_by_spline(y: Array, x: Array, curves: Curves) -> None:
    """y (1 + s(x)) in place of y, float64[samples, swarm];  x : float64[samples]"""
    low, scale, extremes, knots, pieces = curves
    now = np.empty(low.size)
    for i in range(x.size):
        splines_at(x[i], low, scale, extremes, knots, pieces, now)
        for j in range(now.size):
            y[i, j] *= 1.0 + now[j]

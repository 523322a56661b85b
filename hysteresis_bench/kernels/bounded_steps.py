"""Small quadratic problems with bounds: the steps of a bounded least-squares descent.

Block principal pivoting [1]: every coordinate is free, or at one of its bounds; all that contradict the optimality
conditions change sides at once, and where that no longer helps, only the last of them, which cannot cycle [2].

[1] J. J. Júdice, F. M. Pires, A block principal pivoting algorithm for large-scale strictly monotone linear
    complementarity problems, Computers and Operations Research 21 (1994) 587.
[2] K. G. Murty, Note on a Bard-type scheme for solving the complementarity problem, Opsearch 11 (1974) 123.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

PATIENCE = 3
"""Exchanges of whole blocks without progress before single ones follow, as in [1]."""
EXCHANGES = 100
"""At most so many for each coordinate; rounding may keep a coordinate of no slope between its sides for ever."""
ROUNDED = 1e-16
"""Share of a matrix's diagonal below which what elimination leaves of it is rounding."""

FREE, AT_LOW, AT_HIGH = 0, 1, 2


def bounded_steps(matrices: Array, descents: Array, low: Array, high: Array) -> Array:
    """Steps s (problems, d) that minimize s A s / 2 - b s with low <= s <= high.

    matrices : A, (problems, d, d), symmetric and positive definite;  descents : b, (problems, d)
    low, high : (problems, d), low <= 0 <= high
    """
    A, b, least, most = map(np.ascontiguousarray, (matrices, descents, low, high))
    steps = np.empty(b.shape)
    _pivoted(A, b, least, most, steps)
    return np.clip(steps, low, high)


@njit(cache=True, error_model="numpy")
def _pivoted(matrices: Array, descents: Array, low: Array, high: Array, steps: Array) -> None:
    """As `bounded_steps`, into steps; but for rounding within the bounds."""
    dimension = descents.shape[1]
    sides, better, free = np.empty((3, dimension), dtype=np.int64)
    factors, spare = np.empty((dimension, dimension)), np.empty((2, dimension))
    for problem in range(descents.shape[0]):
        A, b, least, most, s = matrices[problem], descents[problem], low[problem], high[problem], steps[problem]
        sides[:] = FREE
        fewest, patience = dimension + 1, PATIENCE
        for _ in range(EXCHANGES * dimension):
            _solved(A, b, least, most, sides, s, free, factors, spare)
            count, last = _contradicted(A, b, least, most, sides, s, better)
            if count == 0:
                break
            patience = PATIENCE if count < fewest else patience - 1
            fewest = min(fewest, count)
            for k in range(last if patience < 0 else 0, last + 1):
                sides[k] = better[k]


@njit(cache=True, error_model="numpy")
def _contradicted(
    A: Array, b: Array, low: Array, high: Array, sides: Array, s: Array, better: Array
) -> tuple[int, int]:
    """Into better the sides that the conditions of optimality want -> how many are others, the last of them."""
    count, last = 0, 0
    for k in range(sides.size):
        side = sides[k]
        if side == FREE:
            better[k] = AT_LOW if s[k] < low[k] else (AT_HIGH if s[k] > high[k] else FREE)
        else:
            slope = b[k]
            for j in range(sides.size):
                slope -= A[k, j] * s[j]
            better[k] = FREE if (slope > 0.0 if side == AT_LOW else slope < 0.0) else side
        if better[k] != side:
            count, last = count + 1, k
    return count, last


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _solved(
    A: Array, b: Array, low: Array, high: Array, sides: Array, s: Array, free: Array, factors: Array, spare: Array
) -> None:
    """The steps with some coordinates at their bounds: of the others A = L D L^T, where every row is eliminated from
    all below it at once, so that loops over columns are vectorised. free, factors, spare : overwritten"""
    right, column = spare
    count = 0
    for k in range(sides.size):
        if sides[k] == FREE:
            free[count] = k
            count += 1
        else:
            s[k] = low[k] if sides[k] == AT_LOW else high[k]
    for row in range(count):
        k = free[row]
        total = b[k]
        for j in range(sides.size):
            total -= A[k, j] * s[j] if sides[j] != FREE else 0.0
        right[row] = total
        for place in range(row + 1):
            factors[row, place] = A[k, free[place]]
    for pivot in range(count):
        k = free[pivot]
        below = max(factors[pivot, pivot], ROUNDED * A[k, k])
        factors[pivot, pivot] = below
        for row in range(pivot + 1, count):
            column[row] = factors[row, pivot]
        for row in range(pivot + 1, count):
            share = column[row] / below
            right[row] -= share * right[pivot]
            factors[row, pivot] = share
            for place in range(pivot + 1, row + 1):
                factors[row, place] -= share * column[place]
    for row in range(count):
        right[row] /= factors[row, row]
    for row in range(count - 1, -1, -1):
        s[free[row]] = right[row]
        for place in range(row):
            right[place] -= factors[row, place] * right[row]

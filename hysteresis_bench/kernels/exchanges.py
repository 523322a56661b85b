"""What an exchange of block principal pivoting asks of a matrix, but for the factorization."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True)
def part_of(matrix: Array, places: Array) -> Array:
    """Rows and columns of a symmetric matrix, (some, some): the upper triangle; what is below it is undefined."""
    some = places.size
    part = np.empty((some, some))
    for i in range(some):
        row = matrix[places[i]]
        for j in range(i, some):
            part[i, j] = row[places[j]]
    return part


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def wrong_sides(
    matrix: Array, right: Array, free: Array, inside: Array, found: Array, close: float
) -> tuple[Array, Array, Array]:
    """The slope matrix found - right, and the places on the wrong side: those inside below 0, but for the free ones,
    and those held at 0 where it falls, by more than the share `close` of the largest."""
    size = right.size
    slope, below, uphill = -right, np.empty(size, dtype=np.int64), np.empty(size, dtype=np.int64)
    for i in range(size):
        if inside[i]:
            for j in range(size):
                slope[j] += matrix[i, j] * found[i]
    low, flat = -close * np.max(np.abs(found)), -close * np.max(np.abs(right))
    belows, uphills = 0, 0
    for i in range(size):
        if inside[i] and not free[i] and found[i] < low:
            below[belows] = i
            belows += 1
        if not inside[i] and slope[i] < flat:
            uphill[uphills] = i
            uphills += 1
    return slope, below[:belows], uphill[:uphills]

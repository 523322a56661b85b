"""Which columns of a swarm are alike in some of their rows."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True)
def _alike(columns: Array, rows: Array, one: int, other: int) -> bool:
    alike = True
    for row in rows:
        alike = alike and columns[row, one] == columns[row, other]
    return alike


@njit(cache=True)
def distinct_columns(columns: Array, rows: Array) -> tuple[Array, Array]:
    """The first place of each distinct column, and which of these every column is.

    columns : float64[any, swarm];  rows : int64[some], that are compared
    -> int64[distinct], int64[swarm]    where no two neighbours are alike, all pass for distinct: a look at that costs
                                        next to nothing
    """
    swarm = columns.shape[1]
    neighbours = 0
    for j in range(1, swarm):
        neighbours += 1 if _alike(columns, rows, j, j - 1) else 0
    if neighbours == 0:
        return np.arange(swarm), np.arange(swarm)
    first, place, count = np.empty(swarm, dtype=np.int64), np.empty(swarm, dtype=np.int64), 0
    for j in range(swarm):
        found = 0
        while found < count and not _alike(columns, rows, j, first[found]):
            found += 1
        place[j] = found
        if found == count:
            first[count] = j
            count += 1
    return first[:count], place

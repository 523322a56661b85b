"""The type of every array here: float64 unless a docstring says otherwise; shapes stand in the docstrings."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]


def distinct_columns(columns: Array) -> tuple[Array, Array]:
    """Which columns of (rows, swarm) differ to the last bit: the first place of each, and for every column which one
    it is (swarm,). Where no two neighbours are alike, all pass for distinct: a look at that costs next to nothing."""
    swarm = columns.shape[1]
    if not np.any(np.all(columns[:, 1:] == columns[:, :-1], axis=0)):
        return np.arange(swarm), np.arange(swarm)
    known: dict[bytes, int] = {}
    place = np.array([known.setdefault(column.tobytes(), len(known)) for column in columns.T])
    return np.unique(place, return_index=True)[1], place

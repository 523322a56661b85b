"""The size of noise among outliers."""

from __future__ import annotations

import math

from numba import njit

from hysteresis_bench.arrays import Array

ROUNDS = 20
SETTLED = 1e-4
"""Relative change of the RMS from which another round changes nothing that matters."""


@njit(cache=True, error_model="numpy", fastmath={"reassoc", "contract"})
def clipped_rms(sizes: Array, rms: float, clip: float, shrink: float) -> tuple[float, int]:
    """RMS of the values below `clip` times the RMS, until the two agree -> it, and how many values it rests on.

    sizes : float64[values]    absolute values
    rms : where to begin, unit of the values
    shrink : RMS of a normal variable that is clipped likewise; the result is divided by it
    """
    kept = sizes.size
    for _ in range(ROUNDS):
        limit = clip * rms
        total = 0.0
        kept = 0
        for value in sizes:
            inside = value <= limit
            total += value * value if inside else 0.0
            kept += 1 if inside else 0
        new = math.sqrt(total / kept) / shrink if kept > 0 else 0.0
        if abs(new - rms) <= SETTLED * rms:
            return new, kept
        rms = new
    return rms, kept

"""Cells with dry friction and a mean field, one sample on; state: started, m, then where every cell is.

Constants: cells, a, field of the mean, slope, M_s, the pinning of the cells, their shares.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.energy_based import CLOSE, MOST_STEPS, STEEPEST
from hysteresis_bench.kernels.langevin import langevin_ratio
from hysteresis_bench.kernels.play import played


def mean(s: Array, p: Array, h: float) -> tuple[float, float]:
    """The mean magnetization in an acting field h, and its slope; before the first sample the cells are free."""
    cells: int = int(p[0])
    m = 0.0
    slope = 0.0
    for k in range(cells):
        place = played(h, p[5 + k] * s[0], s[2 + k])
        ratio = langevin_ratio(place / p[1])
        L = place / p[1] * ratio
        m += p[5 + cells + k] * L
        if place != s[2 + k]:
            slope += p[5 + cells + k] * (1.0 - L * L - 2.0 * ratio) / p[1]
    return m, slope


def law(s: Array, p: Array, t: float, u: float) -> float:
    cells: int = int(p[0])
    low = -1.0
    high = 1.0
    for _ in range(MOST_STEPS):
        m = s[1]
        found, slope = mean(s, p, u + p[2] * m)
        if found >= m:
            low = m
        if found <= m:
            high = m
        s[1] = m + (found - m) / (1.0 - min(p[2] * slope, STEEPEST))
        if s[1] < low or s[1] > high:
            s[1] = 0.5 * (low + high)
        if abs(s[1] - m) <= CLOSE:
            break
    h = u + p[2] * s[1]
    for k in range(cells):
        s[2 + k] = played(h, p[5 + k] * s[0], s[2 + k])
    s[0] = 1.0
    return p[3] * u + p[4] * s[1]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    pinning = p["pinning"] * np.exp(p["spread"] * model._quantiles)
    shares = [p["reversible"], *[(1.0 - p["reversible"]) / model.cells] * model.cells]
    first = (float(model.cells + 1), p["a"], 3.0 * p["a"] * p["coupling"], p["slope"], p["M_s"])
    return Part((*first, 0.0, *map(float, pinning), *shares), state=model.cells + 3)

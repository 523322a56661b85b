"""Dahl's friction, one sample on; state: started, u, z, place; constants: distance, i, gap, slope, F_C."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.dahl import slipped


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] != 0.0:
        s[2], s[3] = slipped(s[2], s[3], u - s[1], p[0], p[1], p[2])
    s[0] = 1.0
    s[1] = u
    return p[3] * u + p[4] * s[2]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[name] for name in ("distance", "i", "gap", "slope", "F_C")), state=4)

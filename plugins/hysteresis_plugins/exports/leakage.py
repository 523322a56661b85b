"""Leakage beside the model; state: started, t, u, integral of the input; constants: conductance."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] != 0.0:
        s[3] += 0.5 * (u + s[2]) * (t - s[1])
    s[0] = 1.0
    s[1] = t
    s[2] = u
    return y + p[0] * s[3]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["conductance"],), state=4) if timed and p["conductance"] != 0.0 else None

"""Drift of the output; state: started, first time; constants: rate."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[1] = t
    return y + p[0] * (t - s[1])


def undone(s: Array, p: Array, t: float, y: float) -> float:
    return y - after(s, p, t, 0.0, 0.0)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["rate"],), state=2, invertible=True) if timed else None

"""Smooth saturation of the output; constants: inverse level, sharpness."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    excess = abs(p[0] * y)
    if excess == 0.0:
        return y
    least = excess if excess <= 1.0 else 1.0 / excess
    folded = math.exp(-math.log(1.0 + math.exp(p[1] * math.log(least))) / p[1])
    return y * folded if excess <= 1.0 else math.copysign(folded, y) / p[0]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["inverse_level"], p["sharpness"])) if p["inverse_level"] != 0.0 else None

"""An end stop above the output; constants: level, share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y - p[1] * (y - p[0]) if y > p[0] else y


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["level"], p["share"])) if p["share"] != 0.0 else None

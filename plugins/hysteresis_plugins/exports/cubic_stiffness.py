"""A cubic of the input beside the model; constants: its factor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y + p[0] * (u * u * u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["cubic"],)) if p["cubic"] != 0.0 else None

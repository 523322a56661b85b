"""A constant beside the input; constants: offset."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def before(s: Array, p: Array, t: float, u: float) -> float:
    return u + p[0]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((p["offset"],))

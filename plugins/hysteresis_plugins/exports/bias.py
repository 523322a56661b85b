"""A constant on the output."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y + p[0]


def undone(s: Array, p: Array, t: float, y: float) -> float:
    return y - p[0]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((p["offset"],), invertible=True)

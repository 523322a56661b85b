"""A bent input; constants: curvature."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def before(s: Array, p: Array, t: float, u: float) -> float:
    return p[0] * (u * u) + u


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((p["curvature"],))

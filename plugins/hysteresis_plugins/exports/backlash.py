"""Backlash before the hysteresis; state: started, place; constants: half-width."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.play import played


def before(s: Array, p: Array, t: float, u: float) -> float:
    s[1] = u if s[0] == 0.0 else played(u, p[0], s[1])
    s[0] = 1.0
    return s[1]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((p["half_width"],), state=2)

"""A dead zone; constants: share, half-width, centre, rounding, what it holds at 0."""

from __future__ import annotations

import math
from collections.abc import Mapping

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def passed(p: Array, x: float) -> float:
    beyond = x - p[2] + p[1]
    before = x - p[2] - p[1]
    held = 0.5 * (math.sqrt(beyond * beyond + p[3] * p[3]) - math.sqrt(before * before + p[3] * p[3]))
    return x - p[0] * (held - p[4])


def part_of(p: Mapping[str, float]) -> Part | None:
    share, half, centre, rounding = (p[name] for name in ("share", "half_width", "centre", "rounding"))
    at_zero = 0.5 * (math.hypot(half - centre, rounding) - math.hypot(half + centre, rounding))
    return Part((share, half, centre, rounding, at_zero)) if half != 0.0 else None

"""An end stop above the output; constants: level, share, rounding."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    beyond = y - p[0]
    return y - 0.5 * p[1] * (beyond + math.sqrt(beyond * beyond + p[2] * p[2]))


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["level"], p["share"], p["rounding"])) if p["share"] != 0.0 else None

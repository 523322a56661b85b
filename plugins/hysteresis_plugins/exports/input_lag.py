"""A lag before the hysteresis; constants: its time constant."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.lag import STATE, lagged


def before(s: Array, p: Array, t: float, u: float) -> float:
    return u + lagged(s, 0, p[0], t, u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["time_constant"],), STATE) if timed and p["time_constant"] > 0.0 else None

"""A zero that moves with time; state: started, first time; constants: of its spline."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.zero_with_time import ZERO
from hysteresis_plugins.exports.spline import constants_of, spline_at


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[1] = t
    return y + spline_at(p, 0, t - s[1])


def undone(s: Array, p: Array, t: float, y: float) -> float:
    return y - after(s, p, t, 0.0, 0.0)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part(constants_of(ZERO, 0.0, p["duration"], p), state=2, invertible=True) if timed else None

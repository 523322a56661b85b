"""A gain that changes with time; state: started, first time; constants: of its spline."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.gain_with_time import GAIN
from hysteresis_plugins.exports.spline import constants_of, spline_at


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[1] = t
    return y * (1.0 + spline_at(p, 0, t - s[1]))


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part(constants_of(GAIN, 0.0, p["duration"], p), state=2) if timed else None

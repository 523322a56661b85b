"""A gain that changes with the path of the input; state: started, input, path; constants: of its spline."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.gain_with_path import GAIN
from hysteresis_plugins.exports.spline import constants_of, spline_at


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] != 0.0:
        s[2] += abs(u - s[1])
    s[0] = 1.0
    s[1] = u
    return y * (1.0 + spline_at(p, 0, s[2]))


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(constants_of(GAIN, 0.0, p["longest"], p), state=3)

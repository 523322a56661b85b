"""A curve of the input; constants: origin and corner, and those of its spline."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.input_curve import BEND
from hysteresis_plugins.exports.spline import constants_of, spline_at


def before(s: Array, p: Array, t: float, u: float) -> float:
    return u + spline_at(p, 2, u) + p[1] * abs(u - p[0])


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((p["origin"], p["corner"], *constants_of(BEND, p["lowest"], p["highest"], p)))

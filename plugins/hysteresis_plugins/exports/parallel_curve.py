"""A smooth curve of the input beside the model; constants: of its spline."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.parallel_curve import BEND
from hysteresis_plugins.exports.spline import constants_of, spline_at


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y + spline_at(p, 0, u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(constants_of(BEND, p["lowest"], p["highest"], p))

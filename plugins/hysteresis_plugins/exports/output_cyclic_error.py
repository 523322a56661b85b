"""An error of the output's sensor that repeats itself along its scale; constants: of its ripple."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.ripple import part_of, ripple_at


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y + ripple_at(p, y)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return part_of(p)

"""An error of the input that repeats itself along it; constants: of its ripple."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.ripple import part_of, ripple_at


def before(s: Array, p: Array, t: float, u: float) -> float:
    return u + ripple_at(p, u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return part_of(p)

"""A dead zone of the input; constants: of the zone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.dead_zone import part_of, passed


def before(s: Array, p: Array, t: float, u: float) -> float:
    return passed(p, u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return part_of(p)

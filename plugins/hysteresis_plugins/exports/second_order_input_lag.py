"""A second-order lag before the hysteresis; constants: damping, stiffness."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.resonance import STATE, staged


def before(s: Array, p: Array, t: float, u: float) -> float:
    return staged(s, 0, p[0], p[1], t, u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    if not timed or p["time_constant"] == 0.0:
        return None
    omega = 2.0 * p["damping"] / p["time_constant"]
    return Part((2.0 * p["damping"] * omega, omega**2), STATE)

"""A second-order stage, one sample on; constants: damping, stiffness.

State: started, t, input, duration of the known step, its five coefficients, deviation, velocity.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.linear_stage import SAME_STEP
from hysteresis_bench.kernels.second_order import transition

STATE = 11


def staged(s: Array, o: int, damping: float, stiffness: float, t: float, y: float) -> float:
    """o : where the stage's state begins."""
    if s[o] == 0.0:
        s[o] = 1.0
        s[o + 1] = t
        s[o + 2] = y
        return y
    duration = t - s[o + 1]
    if abs(duration - s[o + 3]) > SAME_STEP * s[o + 3]:
        s[o + 3] = duration
        s[o + 4], s[o + 5], s[o + 6], s[o + 7], s[o + 8] = transition(damping, stiffness, duration)
    slope = (y - s[o + 2]) / duration
    deviation = s[o + 4] * s[o + 9] + s[o + 5] * s[o + 10] - s[o + 8] * slope
    s[o + 10] = s[o + 6] * s[o + 9] + s[o + 7] * s[o + 10] + (1.0 - s[o + 4]) * slope
    s[o + 9] = deviation
    s[o + 1] = t
    s[o + 2] = y
    return y + deviation


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return staged(s, 0, p[0], p[1], t, y)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    if not timed or p["period"] == 0.0:
        return None
    omega = 2.0 * np.pi / p["period"]
    if p["damping"] < 0.0:
        raise ValueError("with a damping below 0 it is not stable")
    return Part((2.0 * p["damping"] * omega, omega**2), STATE)

"""A first-order lag, one sample on; state: started, t, input, known step, kept, passed, deviation."""

from __future__ import annotations

import math

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.linear_stage import SAME_STEP

STATE = 7


def lagged(s: Array, o: int, time_constant: float, t: float, u: float) -> float:
    """The deviation from u; o : where the lag's state begins."""
    if s[o] == 0.0:
        s[o] = 1.0
        s[o + 1] = t
        s[o + 2] = u
        return 0.0
    passed = step_of(s, o, time_constant, t)
    s[o + 6] = s[o + 4] * s[o + 6] - passed * (u - s[o + 2])
    s[o + 1] = t
    s[o + 2] = u
    return s[o + 6]


def step_of(s: Array, o: int, time_constant: float, t: float) -> float:
    """The share of a rise of u that it is late by after the step to t; what is kept of the deviation is s[o + 4]."""
    step = t - s[o + 1]
    if abs(step - s[o + 3]) > SAME_STEP * s[o + 3]:
        s[o + 3] = step
        x = step / time_constant
        s[o + 4] = math.exp(-x)
        s[o + 5] = -math.expm1(-x) / x if x > 0.0 else 1.0
    return s[o + 5]

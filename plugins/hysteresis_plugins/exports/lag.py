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
    step = t - s[o + 1]
    if abs(step - s[o + 3]) > SAME_STEP * s[o + 3]:
        s[o + 3] = step
        x = step / time_constant
        s[o + 4] = math.exp(-x)
        s[o + 5] = -math.expm1(-x) / x if x > 0.0 else 1.0
    s[o + 6] = s[o + 4] * s[o + 6] - s[o + 5] * (u - s[o + 2])
    s[o + 1] = t
    s[o + 2] = u
    return s[o + 6]

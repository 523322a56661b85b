"""Loss of amplitude with the path of the input; state: started, input, path; constants: rate."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] != 0.0:
        s[2] += abs(u - s[1])
    s[0] = 1.0
    s[1] = u
    return y * math.exp(-p[0] * s[2])


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((p["rate"],), state=3)

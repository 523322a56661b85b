"""Folz-Filiatrault, one sample on; state: started, u at first, x, f, direction, X above, X below.

Constants: the model's parameters in its order.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.timber_step import followed


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[1] = u
    x = (u - s[1]) / p[0]
    if x > s[2]:
        if s[4] < 0.0:
            s[6] = max(s[6], -s[2])
        s[4] = 1.0
        s[3] = followed(s[3], x, x - s[2], s[5], max(s[5], s[6]), p)
    elif x < s[2]:
        if s[4] > 0.0:
            s[5] = max(s[5], s[2])
        s[4] = -1.0
        s[3] = -followed(-s[3], -x, s[2] - x, s[6], max(s[5], s[6]), p)
    s[2] = x
    return p[7] * s[3]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[parameter.name] for parameter in model.parameters), state=7)

"""Self-centring, one sample on; state: started, u, z, place, M of either side;
constants: the model's parameters in its order."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.dahl import slipped


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] != 0.0:
        s[2], s[3] = slipped(s[2], s[3], u - s[1], p[3], p[4], 0.0)
    s[0] = 1.0
    s[1] = u
    way = u - p[2]
    small = min(abs(way) / p[0], 1.0)
    large = max(abs(way) / p[0], 1.0)
    s[4] = max(s[4], way / p[0])
    s[5] = max(s[5], -way / p[0])
    bent = small / (1.0 + (small / large) ** p[1]) ** (1.0 / p[1])
    if way < 0.0:
        return p[6] * way - (p[7] - p[9] * s[5] ** p[10]) * bent + p[8] * s[2]
    return p[5] * way + (p[7] - p[9] * s[4] ** p[10]) * bent + p[8] * s[2]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[parameter.name] for parameter in model.parameters), state=6)

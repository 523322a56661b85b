"""Flag-shaped, one sample on; state: way, its part that the spring takes; constants: the model's parameters in its
order."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def law(s: Array, p: Array, t: float, u: float) -> float:
    way = u - p[3]
    size = abs(way)
    free = size
    if way * s[0] >= 0.0:
        free = abs(s[1]) + size - abs(s[0])
    most = p[0]
    least = p[0] * max(1.0 - p[1], 1e-12)
    small = min(size / most, 1.0)
    large = max(size / most, 1.0)
    upper = most * small / (1.0 + (small / large) ** p[2]) ** (1.0 / p[2])
    small = min(size / least, 1.0)
    large = max(size / least, 1.0)
    lower = least * small / (1.0 + (small / large) ** p[2]) ** (1.0 / p[2])
    x = max(min(free, upper), lower)
    s[0] = way
    if way < 0.0:
        s[1] = -x
        return p[6] * way - p[5] * x
    s[1] = x
    return p[6] * way + p[4] * x


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[parameter.name] for parameter in model.parameters), state=2)

"""Duhem's hysteresis, one sample on; state: started, input, tanh and its slope, lag; constants: the model's parameters
in its order."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def law(s: Array, p: Array, t: float, u: float) -> float:
    curve = math.tanh((u - p[1]) / p[2])
    steep = (1.0 - curve * curve) / p[2]
    if s[0] != 0.0:
        step = u - s[1]
        chord = curve - s[2]
        way = abs(step)
        most = 3.0 * abs(chord)
        begins = min(s[3] * way, most)
        ends = min(steep * way, most)
        if step < 0.0:
            begins = -begins
            ends = -ends
        x = p[0] * way
        mean = 1.0
        first = 0.5
        second = 0.0
        if x < 0.5:
            for k in range(14):
                second = (1.0 - x * second) / (16.0 - k)
            first = 0.5 * (1.0 - x * second)
            mean = 1.0 - x * first
        else:
            mean = (1.0 - math.exp(-x)) / x
            first = (1.0 - mean) / x
            second = (1.0 - 2.0 * first) / x
        along = begins * (mean - 4.0 * first + 3.0 * second) + ends * (3.0 * second - 2.0 * first)
        along += 6.0 * chord * (first - second)
        s[4] = (1.0 - x * mean) * s[4] + p[5] * step * mean + p[6] * along
    s[0] = 1.0
    s[1] = u
    s[2] = curve
    s[3] = steep
    return p[3] * u + p[4] * curve - s[4]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[parameter.name] for parameter in model.parameters), state=5)

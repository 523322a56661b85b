"""A lag with a time constant of its own at every level, one sample on; state: started, t, what lags, what follows;
constants: the lowest and the highest level, the time constants from there to there."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.lag_with_level import LEAST, PARTS, SMALL
from hysteresis_plugins.effects.free.lags._level import CONSTANTS

STATE = 4


def followed(s: Array, p: Array, t: float, x: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[3] = x
    else:
        whole = t - s[1]
        slope = (x - s[2]) / whole
        first = max(time_constant(p, s[3]), LEAST * whole)
        after = moved(p, s[3], s[2], slope, whole, LEAST * whole)
        wrong = abs(after - held(s[3], s[2], slope, whole, first)) / (p[1] - p[0])
        parts: int = int(min(math.ceil(math.sqrt(wrong / SMALL)), PARTS))
        if parts > 1:
            step = whole / parts
            after = s[3]
            for k in range(parts):
                after = moved(p, after, s[2] + slope * step * k, slope, step, LEAST * whole)
        s[3] = after
    s[1] = t
    s[2] = x
    return s[3]


def moved(p: Array, v: float, x: float, slope: float, step: float, least: float) -> float:
    """After a step with the time constant in the middle of it."""
    first = max(time_constant(p, v), least)
    middle = held(v, x, slope, 0.5 * step, first)
    return held(v, x, slope, step, max(time_constant(p, middle), least))


def time_constant(p: Array, level: float) -> float:
    place = 4.0 * (level - p[0]) / (p[1] - p[0])
    tau = p[2]
    for k in range(4):
        tau += (p[3 + k] - p[2 + k]) * min(max(place - k, 0.0), 1.0)
    return tau


def held(v: float, x: float, slope: float, step: float, tau: float) -> float:
    """After a step with a time constant that is held, from a signal that begins at x."""
    decay = math.expm1(-step / tau)
    return v - decay * (x - v) + slope * (step + tau * decay)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    values = [p[f"time_constant_{name}"] for name in CONSTANTS]
    return Part((p["bottom"], p["top"], *values), STATE) if timed and any(values) else None

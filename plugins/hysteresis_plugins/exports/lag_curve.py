"""A lag by a curve of the rate, one sample on; state: started, t, what lags, distance behind; constants: the rate of
the bend, the time constants from the fastest fall to the fastest rise."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.lag_curve import LEAST
from hysteresis_plugins.effects.free.lags._rate import CONSTANTS

STATE = 4


def followed(s: Array, p: Array, t: float, x: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
    else:
        step = t - s[1]
        s[3] = moved(s[3], (x - s[2]) / step, step, p)
    s[1] = t
    s[2] = x
    return x - s[3]


def moved(d: float, rate: float, step: float, p: Array) -> float:
    """The distance behind after a step on which the signal changes at a rate."""
    bottom = -p[0] * max(p[2], LEAST * step)
    top = p[0] * max(p[3], LEAST * step)
    slow: int = 2
    fast: int = 1
    if rate >= 0.0:
        slow = 3
        fast = 4
    side = 1.0 if rate >= 0.0 else -1.0
    goal = max(p[slow], LEAST * step) * side * min(side * rate, p[0])
    goal += max(p[fast], LEAST * step) * side * max(side * rate - p[0], 0.0)
    upwards = goal > d
    left = step
    piece: int = 0
    if bottom < d or (upwards and bottom == d):
        piece = 1
    if d > 0.0 or (upwards and d == 0.0):
        piece = 2
    if top < d or (upwards and top == d):
        piece = 3
    while left > 0.0:
        tau = max(p[1 + piece], LEAST * step)
        line = tau * rate
        if piece == 0:
            line = bottom + tau * (rate + p[0])
        if piece == 3:
            line = top + tau * (rate - p[0])
        after = d + math.expm1(-left / tau) * (d - line)
        end = after
        if upwards:
            if piece == 0:
                end = min(after, bottom)
            if piece == 1:
                end = min(after, 0.0)
            if piece == 2:
                end = min(after, top)
        else:
            if piece == 1:
                end = max(after, bottom)
            if piece == 2:
                end = max(after, 0.0)
            if piece == 3:
                end = max(after, top)
        if end == after:
            return after
        left -= tau * math.log1p((d - end) / (end - line))
        d = end
        piece = piece + 1 if upwards else piece - 1
    return d


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    slopes = [p[name] for name in CONSTANTS]
    return Part((p["bend"], *slopes), STATE) if timed and any(slopes) else None

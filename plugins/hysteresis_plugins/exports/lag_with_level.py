"""A lag with a time constant of its own at every level, one sample on; state: started, t, what lags, what follows, what
the second stage added; constants: the lowest and the highest level, the time constants from there to there."""

from __future__ import annotations

import math
from collections import namedtuple
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.lag_with_level import LEAST, NEAR, PARTS, SMALL, STIFFEST
from hysteresis_plugins.effects.free.lags._level import constants

STATE = 5


def followed(s: Array, p: Array, t: float, x: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[3] = x
    else:
        whole = t - s[1]
        slope = (x - s[2]) / whole
        before = s[3]
        moved(s, p, s[2], slope, whole, LEAST * whole)
        wrong = s[4] / (p[1] - p[0])
        parts: int = int(min(math.ceil(pow(wrong / SMALL, 1.0 / 3.0)), PARTS))
        if parts > 1:
            step = whole / parts
            s[3] = before
            for k in range(parts):
                moved(s, p, s[2] + slope * step * k, slope, step, LEAST * whole)
    s[1] = t
    s[2] = x
    return s[3]


def moved(s: Array, p: Array, x: float, slope: float, step: float, least: float) -> float:
    """After a step from a signal that begins at x."""
    v = s[3]
    tau = max(time_constant(p, v), least)
    speed = (x - v) / tau
    stiffness = min(-(1.0 + speed * rise(p, v)) / tau, STIFFEST / step)
    first = weight(step * stiffness, 1)
    second = weight(step * stiffness, 2)
    third = weight(step * stiffness, 3)
    change = step * (first * speed + step * second * slope / tau)
    end = x + slope * step
    there = (end - v - change) / max(time_constant(p, v + change), least)
    more = 2.0 * step * third * (there - speed - stiffness * change - slope / tau * step)
    s[3] = min(max(v + change + more, min(min(x, end), v)), max(max(x, end), v))
    s[4] = abs(more)
    return s[3]


def time_constant(p: Array, level: float) -> float:
    place = 4.0 * (level - p[0]) / (p[1] - p[0])
    tau = p[2]
    for k in range(4):
        tau += (p[3 + k] - p[2 + k]) * min(max(place - k, 0.0), 1.0)
    return tau


def rise(p: Array, level: float) -> float:
    """How steeply the time constant rises."""
    place = 4.0 * (level - p[0]) / (p[1] - p[0])
    steep = 0.0
    for k in range(4):
        if place >= k and place < k + 1.0:
            steep = p[3 + k] - p[2 + k]
    return steep * 4.0 / (p[1] - p[0])


def weight(z: float, order: int) -> float:
    """(exp(z) - 1) / z for the order 1, and on from each by (phi_k - 1 / k!) / z."""
    if abs(z) <= NEAR:
        total = 1.0
        for k in range(12):
            total = 1.0 + z * total / (order + 12.0 - k)
        return total / order if order < 3 else total / 6.0
    phi = math.expm1(max(z, -708.0)) / z
    if order > 1:
        phi = (phi - 1.0) / z
    if order > 2:
        phi = (phi - 0.5) / z
    return phi


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    times = [float(tau) for tau in constants(namedtuple("Values", list(p))(**p))]
    return Part((p["bottom"], p["top"], *times), STATE) if timed and p["time_constant"] else None

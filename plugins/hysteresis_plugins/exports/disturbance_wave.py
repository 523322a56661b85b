"""A wave that swells along splines; state: started, first time; constants: frequency, overtones, place, splines."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.disturbance_wave import CONSTANT, SWELLS
from hysteresis_plugins.exports.spline import constants_of, spline_at


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[1] = t
    phase = 2.0 * math.pi * p[0] * t
    wave = spline_at(p, 6, t - s[1]) * math.cos(phase) + spline_at(p, int(p[5]), t - s[1]) * math.sin(phase)
    wave += p[1] * math.cos(2.0 * phase) + p[2] * math.sin(2.0 * phase)
    return y + wave + p[3] * math.cos(3.0 * phase) + p[4] * math.sin(3.0 * phase)


def undone(s: Array, p: Array, t: float, y: float) -> float:
    return y - after(s, p, t, 0.0, 0.0)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    if not timed:
        return None
    cosine, sine = (constants_of(swell, 0.0, p["duration"], p) for swell in SWELLS)
    overtones = (p[one.name] for one in CONSTANT)
    return Part((p["frequency"], *overtones, 6.0 + len(cosine), *cosine, *sine), state=2, invertible=True)

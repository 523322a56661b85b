"""Creep as lags of equal weight; constants: number, weight of each, time constants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.lag import STATE, lagged, step_of


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    late = 0.0
    for k in range(int(p[0])):
        late += lagged(s, k * STATE, p[2 + k], t, y)
    return y + p[1] * late


def undone(s: Array, p: Array, t: float, y: float) -> float:
    """The output before the creep: stable for shares below 1, where creep is the smaller part of what is passed."""
    missing, share = y, 1.0
    for k in range(int(p[0])):
        if s[k * STATE] != 0.0:
            late = step_of(s, k * STATE, p[2 + k], t)
            missing -= p[1] * (s[k * STATE + 4] * s[k * STATE + 6] + late * s[k * STATE + 2])
            share -= p[1] * late
    v = missing / share
    for k in range(int(p[0])):
        lagged(s, k * STATE, p[2 + k], t, v)
    return v


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    count = effect.relaxations
    if not timed or p["share"] == 0.0:
        return None
    place = np.linspace(-0.5, 0.5, count)
    times = p["time_constant"] * 10.0 ** (place * p["decades"])
    return Part((float(count), p["share"] / count, *map(float, times)), count * STATE, invertible=p["share"] < 1.0)

"""Creep as lags of equal weight; constants: number, weight of each, time constants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.lag import STATE, lagged


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    late = 0.0
    for k in range(int(p[0])):
        late += lagged(s, k * STATE, p[2 + k], t, y)
    return y + p[1] * late


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    count = effect.relaxations
    if not timed or p["share"] == 0.0:
        return None
    place = np.linspace(-0.5, 0.5, count)
    times = p["time_constant"] * 10.0 ** (place * p["decades"])
    return Part((float(count), p["share"] / count, *map(float, times)), count * STATE)

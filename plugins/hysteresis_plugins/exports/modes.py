"""What a signal becomes through two modes of any weights; constants: damping, stiffness, lead and weight of each."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.lags._modes import MODES, stage, weights
from hysteresis_plugins.exports.resonance import STATE, staged

VELOCITY = 10
"""Where a stage keeps it in its state."""


def arrived(s: Array, p: Array, t: float, x: float) -> float:
    late = 0.0
    for k in range(2):
        mode = staged(s, k * STATE, p[4 * k], p[4 * k + 1], t, x)
        late += p[4 * k + 3] * (mode + p[4 * k + 2] * s[k * STATE + VELOCITY] - x)
    return x + late


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    values = namedtuple("Values", list(p))(**p)
    if not timed or not any(weights(values)):
        return None
    constants = [(*map(float, stage(values, k)), w) for k, w in zip(MODES, weights(values), strict=True)]
    return Part(tuple(one for each in constants for one in each), len(MODES) * STATE)

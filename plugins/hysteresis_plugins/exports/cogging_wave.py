"""A force beside the model of any waveform along the input; constants: 2 pi over its period, amplitudes in pairs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.cogging_wave import WAVES


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    added = 0.0
    for k in range(6):
        turn = (k + 1) * p[0] * u
        added += p[1 + 2 * k] * math.sin(turn) + p[2 + 2 * k] * math.cos(turn)
    return y + added


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((2.0 * math.pi / p["period"], *(p[name] for name in WAVES)))

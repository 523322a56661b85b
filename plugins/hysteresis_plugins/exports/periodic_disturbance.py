"""A sinusoid on the output; constants: cosine, sine, frequency."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    phase = 2.0 * math.pi * p[2] * t
    return y + p[0] * math.cos(phase) + p[1] * math.sin(phase)


def undone(s: Array, p: Array, t: float, y: float) -> float:
    return y - after(s, p, t, 0.0, 0.0)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["cosine"], p["sine"], p["frequency"]), invertible=True) if timed else None

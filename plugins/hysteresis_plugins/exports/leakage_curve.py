"""A current along a curve of the input; state: started, t, input, integral; constants: largest input, currents."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.leakage_curve import ORDERS


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    now = u * p[0]
    if s[0] != 0.0:
        total = 0.0
        powers = 1.0
        last = 1.0
        for k in range(int(p[1])):
            last = last * now
            powers = powers * s[2] + last
            total += p[2 + k] / (k + 2.0) * powers
        s[3] += (t - s[1]) * total
    s[0] = 1.0
    s[1] = t
    s[2] = now
    return y + s[3]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    currents = [p[f"current{k}"] for k in ORDERS]
    return Part((1.0 / p["largest"], float(len(ORDERS)), *currents), state=4) if timed and any(currents) else None

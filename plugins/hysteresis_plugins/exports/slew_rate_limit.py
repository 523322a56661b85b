"""A slew-rate limit before the hysteresis; state: started, t, input, what follows it; constants: rates up and down."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.slew_limit import followed


def before(s: Array, p: Array, t: float, u: float) -> float:
    s[3] = u if s[0] == 0.0 else followed(t - s[1], s[2], u, s[3], p[0], p[1])
    s[0] = 1.0
    s[1] = t
    s[2] = u
    return s[3]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    slowness, skew = p["slowness"], p["skew"]
    rates = (1.0 / (slowness * (1.0 - skew)), 1.0 / (slowness * (1.0 + skew))) if slowness > 0.0 else ()
    return Part(rates, state=4) if timed and rates else None

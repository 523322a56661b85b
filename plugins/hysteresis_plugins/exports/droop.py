"""Droop after the hysteresis; state: the lag's, the first response; constants: the time constant, the share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.lag import STATE, lagged


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] == 0.0:
        s[7] = y
    return y - p[1] * (y - s[7] + lagged(s, 0, p[0], t, y))


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((1.0 / p["rate"], p["share"]), STATE + 1) if timed and p["rate"] > 0.0 else None

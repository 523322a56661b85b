"""A bank of plays before the law; state: started, the plays; constants: number, half-widths from 0, shares."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.play_bank import NAMES, PLAYS
from hysteresis_plugins.exports.prandtl_ishlinskii import law


def before(s: Array, p: Array, t: float, u: float) -> float:
    return law(s, p, t, u)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    shares = [p[name] for name in NAMES]
    radii = (k * (p["reach"] / PLAYS) for k in range(PLAYS + 1))
    return Part((float(PLAYS + 1), *radii, 1.0 - sum(shares), *shares), state=PLAYS + 2)

"""Bouc-Wen and a second-order stage, one sample on; state and constants of both in this order, then the gain."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports import bouc_wen
from hysteresis_plugins.exports.bouc_wen import inverse as driven
from hysteresis_plugins.exports.bouc_wen import law as hysteresis
from hysteresis_plugins.exports.resonance import STATE, staged


def law(s: Array, p: Array, t: float, u: float) -> float:
    return p[7] * staged(s, 3, p[5], p[6], t, hysteresis(s, p, t, u))


def inverse(s: Array, p: Array, v: float) -> float:
    return driven(s, p, v / p[7])


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    first = bouc_wen.part(model, p, timed)
    stage = (p["c_over_m"], p["k_over_m"] if timed else float("inf"), p["b"] / p["k_over_m"])
    if min(stage) <= 0.0:
        raise ValueError("its linear stage is not stable")
    constants, state = (*first.constants, *stage), first.state + STATE
    dynamics = "the linear stage of hammerstein" if timed else ""
    return replace(first, constants=constants, state=state, not_undone=dynamics)

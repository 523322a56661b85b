"""Generalized Bouc-Wen, one sample on; state: started, u, z, E; constants: the model's parameters in its order."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.bouc_wen_generalized_step import strained


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] != 0.0:
        s[2], s[3] = strained(s[2], s[3], u - s[1], p)
    s[0] = 1.0
    s[1] = u
    return p[10] * u + p[11] * s[2]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[parameter.name] for parameter in model.parameters), state=4)

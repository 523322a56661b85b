"""Cyclic plasticity of a metal, one sample on; state: stress, X_1, X_2 and path, all over E, started, u.

Constants: those of the kernel, and E.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.metal_plasticity_step import flowed


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[4] != 0.0 and u != s[5]:
        flowed(s, u - s[5], p)
    s[4] = 1.0
    s[5] = u
    return p[9] * s[0]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    u_y, stresses = p["u_y"], ("Q", "D", "S_1", "S_2")
    names = ("Q", "b", "D", "a", "S_1", "gamma_1", "S_2", "gamma_2")
    return Part((u_y, *(p[name] * (u_y if name in stresses else 1.0) for name in names), p["E"]), state=6)

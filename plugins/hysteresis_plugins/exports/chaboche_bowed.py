"""Cyclic plasticity of a coupon that bows, one sample on; state: that of `chaboche`, of the strain of the metal.

Constants: those of `chaboche`, then bow, u_b, loss and the compression that bows at most.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.metal_plasticity_step import flowed
from hysteresis_plugins.exports import chaboche
from hysteresis_plugins.models.chaboche_bowed import LEAST, MOST


def law(s: Array, p: Array, t: float, u: float) -> float:
    compression = max(-u - p[11], 0.0)
    bowing = min(compression, p[13])
    metal = u + p[10] * bowing * (compression - 0.5 * bowing)
    if s[4] != 0.0 and metal != s[5]:
        flowed(s, metal - s[5], p)
    s[4] = 1.0
    s[5] = metal
    return (p[9] + p[12] * min(u, 0.0)) * s[0]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    known = chaboche.part(model, p, timed)
    return Part((*known.constants, p["bow"], p["u_b"], p["loss"], MOST / max(p["bow"], LEAST)), known.state)

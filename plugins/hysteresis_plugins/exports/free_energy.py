"""Homogenized free energy, one sample on; constants: slope, amplitude, scale, nodes, then radii, then weights.

State: where every play is.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.free_energy import error_function
from hysteresis_bench.kernels.play import played


def law(s: Array, p: Array, t: float, u: float) -> float:
    nodes: int = int(p[3])
    field = p[2] * u
    switched = 0.0
    for j in range(nodes):
        s[j] = played(field, p[4 + j], s[j])
        switched += p[4 + nodes + j] * error_function(s[j])
    return p[0] * u + p[1] * switched


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    slope, amplitude, mean, spread, interaction, offsets, weights = model._law(SimpleNamespace(**p))
    scale = 1.0 / (interaction * math.sqrt(2.0))
    radii = [scale * mean * math.exp(2.0 * spread * (spread + float(offset))) for offset in offsets]
    first = (float(slope), float(amplitude), scale, float(len(radii)))
    return Part((*first, *radii, *map(float, weights)), state=len(radii))

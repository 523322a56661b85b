"""Populations of switching domains, one sample on; state: started, then where every play is.

Constants: populations, permittivity, then height, coercive field, internal field and width of each.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.play import played


def law(s: Array, p: Array, t: float, u: float) -> float:
    populations: int = int(p[0])
    y = p[1] * u
    for k in range(populations):
        s[1 + k] = u if s[0] == 0.0 else played(u, p[3 + 4 * k], s[1 + k])
        y += p[2 + 4 * k] * math.tanh((s[1 + k] - p[4 + 4 * k]) / p[5 + 4 * k])
    s[0] = 1.0
    return y


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    own = [p[f"{name}_{k + 1}"] for k in range(model.populations) for name in ("P", "r", "b", "w")]
    return Part((float(model.populations), p["permittivity"], *own), state=model.populations + 1)

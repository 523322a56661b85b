"""Jiles-Atherton, one sample on; constants: alpha, a, k, M_s, c, clamped.

State: started, H, last change of H, Mi, D, M, last changes of D and M.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[4] = first_anhysteretic(u, p[0], p[1], p[3], p[4])
        s[5] = p[4] * s[4]
    elif u != s[1]:
        change = u - s[1]
        ahead = extrapolated(change, s[2])
        inverse_a = 1.0 / p[1]
        pull = p[0] * p[3] / p[1]
        before_D = s[4]
        before_M = s[5]
        s[3], s[4], s[5] = advanced(
            u, abs(change), math.copysign(1.0, change), ahead,
            p[0], inverse_a, pull, p[2], p[3], p[4], s[3], s[4], s[5], s[6], s[7], p[5],
        )  # fmt: skip
        s[2] = change
        s[6] = s[4] - before_D
        s[7] = s[5] - before_M
    s[1] = u
    return MU0 * (u + s[5])


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((*(p[name] for name in ("alpha", "a", "k", "M_s", "c")), float(model.clamped)), state=8)

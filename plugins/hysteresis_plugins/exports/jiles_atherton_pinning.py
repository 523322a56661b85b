"""Jiles-Atherton with pinning that depends on M, one sample on; constants: alpha, a, k, M_s, c, kappa.

State: as of `jiles_atherton`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic
from hysteresis_bench.kernels.jiles_atherton_pinning import LEAST


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[4] = first_anhysteretic(u, p[0], p[1], p[3], p[4])
        s[5] = p[4] * s[4]
    elif u != s[1]:
        change = u - s[1]
        ahead = extrapolated(change, s[2])
        share = (s[5] + 0.5 * ahead * s[7]) / p[3]
        pinned = p[2] * max(1.0 + p[5] * (1.0 - min(share * share, 1.0)), LEAST)
        before_D = s[4]
        before_M = s[5]
        s[3], s[4], s[5] = advanced(
            u, abs(change), math.copysign(1.0, change), ahead,
            p[0], 1.0 / p[1], p[0] * p[3] / p[1], pinned, p[3], p[4], s[3], s[4], s[5], s[6], s[7], 1.0,
        )  # fmt: skip
        s[2] = change
        s[6] = s[4] - before_D
        s[7] = s[5] - before_M
    s[1] = u
    return MU0 * (u + s[5])


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part(tuple(p[name] for name in ("alpha", "a", "k", "M_s", "c", "kappa")), state=8)

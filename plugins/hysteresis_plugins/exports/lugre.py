"""LuGre friction without forces of the velocity, one sample on; state: started, t, u, z.

Constants: distance, stiction, v_s, slope, F_C, timed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.lugre import _excess


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] != 0.0:
        step = u - s[2]
        r = _excess(p[1], step / (t - s[1]), p[2]) if p[5] != 0.0 else 1.0
        end = math.copysign(r, step)
        s[3] = end + (s[3] - end) * math.exp(-abs(step) / (r * p[0]))
    s[0] = 1.0
    s[1] = t
    s[2] = u
    return p[3] * u + p[4] * s[3]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    """Raises ValueError where forces of the velocity act."""
    if timed and (p["sigma_1"] != 0.0 or p["sigma_2"] != 0.0):
        raise ValueError(
            "the velocity at a sample is the central difference, which needs the next sample; "
            "fitted with --fix sigma_1=0 --fix sigma_2=0 it can be"
        )
    return Part((*(p[name] for name in ("distance", "stiction", "v_s", "slope", "F_C")), float(timed)), state=4)

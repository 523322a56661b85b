"""Polynomials of play operators, one sample on; state: started, then where every play is.

Constants: plays, powers, the half-widths, the coefficients of ascending powers from 1, play by play.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.play import played
from hysteresis_plugins.models._plays import thresholds


def law(s: Array, p: Array, t: float, u: float) -> float:
    plays: int = int(p[0])
    powers: int = int(p[1])
    y = 0.0
    for k in range(plays):
        s[1 + k] = u if s[0] == 0.0 else played(u, p[2 + k], s[1 + k])
        value = 0.0
        for m in range(powers):
            value = s[1 + k] * (p[2 + plays + (k + 1) * powers - 1 - m] + value)
        y += value
    s[0] = 1.0
    return y


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    radii = thresholds(np.array([p["radius"]]), model.plays)[:, 0]
    first = (float(model.plays + 1), float(model.degree), *map(float, radii))
    return Part((*first, *(p[name] for name in model.linear)), state=model.plays + 2)

"""Springs that slip, one sample on; state: started, then where the play of every element is.

Constants: elements, slope, gap, the limits, the stiffnesses.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.play import played
from hysteresis_plugins.models._plays import named


def law(s: Array, p: Array, t: float, u: float) -> float:
    elements: int = int(p[0])
    gap = p[2]
    force = p[1] * u
    for k in range(elements):
        s[1 + k] = u if s[0] == 0.0 else played(u, p[3 + k] + gap, s[1 + k])
        strain = u - s[1 + k]
        force += p[3 + elements + k] * (max(strain - gap, 0.0) + min(strain + gap, 0.0))
    s[0] = 1.0
    return force


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    limits = model.limits(np.array([p["radius"]]))[:, 0]
    stiffnesses = [p[name] for name in named("k", model.elements)]
    first = (float(model.elements), p["slope"], p["gap"])
    return Part((*first, *map(float, limits), *stiffnesses), state=model.elements + 1)

"""A sum of play operators, one sample on; state: started, then where every play is, the first of half-width 0.

Constants: plays, their half-widths, rising from 0, their weights.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.play import played
from hysteresis_plugins.models._plays import named, thresholds


def law(s: Array, p: Array, t: float, u: float) -> float:
    plays: int = int(p[0])
    y = 0.0
    for k in range(plays):
        s[1 + k] = u if s[0] == 0.0 else played(u, p[1 + k], s[1 + k])
        y += p[1 + plays + k] * s[1 + k]
    s[0] = 1.0
    return y


def inverse(s: Array, p: Array, v: float) -> float:
    """The plays join a motion one after the other, in the order of their widths: a curve of straight pieces."""
    plays: int = int(p[0])
    steepness = 0.0
    y = 0.0
    for k in range(plays):
        steepness += p[1 + plays + k]
        y += p[1 + plays + k] * s[1 + k]
    if s[0] == 0.0:
        law(s, p, 0.0, v / steepness)
        return s[1]
    heading = 1.0 if (v - y) * steepness > 0.0 else -1.0
    u = s[1]
    slope = 0.0
    for k in range(plays):
        joins = s[1 + k] + heading * p[1 + k]
        reached = y + slope * (joins - u)
        if k > 0 and heading * (reached - v) * steepness >= 0.0:
            break
        y = reached
        u = joins
        slope += p[1 + plays + k]
    law(s, p, 0.0, u + (v - y) / slope)
    return s[1]


def rises(weights: Sequence[float]) -> bool:
    """Whether the output goes one way with the input, however many plays have joined."""
    slopes = np.cumsum(weights)
    return bool(np.all(slopes > 0.0) or np.all(slopes < 0.0))


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    weights = [p["slope"], *(p[name] for name in named("w", model.plays))]
    radii = thresholds(np.array([p["radius"]]), model.plays)[:, 0]
    return Part(
        (float(model.plays + 1), *map(float, radii), *weights), state=model.plays + 2, invertible=rises(weights)
    )

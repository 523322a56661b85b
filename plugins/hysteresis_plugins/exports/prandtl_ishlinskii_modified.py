"""Plays, and a curve of straight pieces behind them, one sample on; state: that of `prandtl_ishlinskii`.

Constants: those of `prandtl_ishlinskii`, zones on each side, centre, slope, edges of the zones above, bends above,
bends below.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.prandtl_ishlinskii import inverse as undriven
from hysteresis_plugins.exports.prandtl_ishlinskii import law as driven
from hysteresis_plugins.exports.prandtl_ishlinskii import rises
from hysteresis_plugins.models._plays import named, thresholds


def law(s: Array, p: Array, t: float, u: float) -> float:
    o: int = 1 + 2 * int(p[0])
    zones: int = int(p[o])
    z = driven(s, p, t, u)
    y = p[o + 2] * z
    for k in range(zones):
        edge = p[o + 3 + k]
        y += p[o + 3 + zones + k] * max(z - p[o + 1] - edge, 0.0)
        y += p[o + 3 + 2 * zones + k] * min(z - p[o + 1] + edge, 0.0)
    return y


def inverse(s: Array, p: Array, v: float) -> float:
    o: int = 1 + 2 * int(p[0])
    zones: int = int(p[o])
    slope = p[o + 2]
    z = p[o + 1]
    y = slope * z
    heading = 1.0 if (v - y) * slope > 0.0 else -1.0
    bends: int = o + 3 + zones if heading > 0.0 else o + 3 + 2 * zones
    for k in range(zones):
        edge = p[o + 1] + heading * p[o + 3 + k]
        reached = y + slope * (edge - z)
        if heading * (reached - v) * slope >= 0.0:
            break
        y = reached
        z = edge
        slope += p[bends + k]
    return undriven(s, p, z + (v - y) / slope)


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    weights = np.array([1.0, *(p[name] for name in named("w", model.plays))])
    weights = weights / np.sum(np.abs(weights))
    radii = thresholds(np.array([p["radius"]]), model.plays)[:, 0]
    edges = thresholds(np.array([p["reach"]]), model.zones)[1:, 0]
    above, below = ([p[name] for name in named(side, model.zones)] for side in ("above", "below"))
    constants = (
        model.plays + 1, *radii, *weights, model.zones, p["centre"], p["slope"], *edges, *above, *below,
    )  # fmt: skip
    monotonic = rises([p["slope"], *above]) and rises([p["slope"], *below])
    return Part(tuple(map(float, constants)), state=model.plays + 2, invertible=monotonic and rises(weights.tolist()))

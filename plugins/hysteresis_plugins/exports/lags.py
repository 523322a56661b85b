"""What a signal becomes through lags of any weights; constants: number, weights, time constants."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.effects.free.lags._spectrum import LAGS, constants
from hysteresis_plugins.exports.lag import STATE, lagged


def arrived(s: Array, p: Array, t: float, x: float) -> float:
    late = 0.0
    lags: int = int(p[0])
    for k in range(lags):
        late += p[1 + k] * lagged(s, k * STATE, p[1 + lags + k], t, x)
    return x + late


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    weights = [p[f"weight{k}"] for k in range(1, LAGS + 1)]
    times = constants(SimpleNamespace(shortest=p["shortest"], longest=p["longest"]))
    return Part((float(LAGS), *weights, *map(float, times)), LAGS * STATE) if timed and any(weights) else None

"""An end stop below the output; constants: level, share."""

from __future__ import annotations

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.stop_above import part as part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y + p[1] * (p[0] - y) if y < p[0] else y

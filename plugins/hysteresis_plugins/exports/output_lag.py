"""A lag after the hysteresis; constants: its time constant."""

from __future__ import annotations

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.input_lag import part as part
from hysteresis_plugins.exports.lag import lagged


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return y + lagged(s, 0, p[0], t, y)

"""A lag by a curve of the rate after the law."""

from __future__ import annotations

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.lag_curve import followed
from hysteresis_plugins.exports.lag_curve import part as part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    return followed(s, p, t, y)

"""A lag by a curve of the rate before the law."""

from __future__ import annotations

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.lag_curve import followed
from hysteresis_plugins.exports.lag_curve import part as part


def before(s: Array, p: Array, t: float, u: float) -> float:
    return followed(s, p, t, u)

"""A lag with a time constant of its own at every level before the law."""

from __future__ import annotations

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.lag_with_level import followed
from hysteresis_plugins.exports.lag_with_level import part as part


def before(s: Array, p: Array, t: float, u: float) -> float:
    return followed(s, p, t, u)

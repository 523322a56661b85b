"""Two modes of any weights before the law."""

from __future__ import annotations

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.modes import arrived
from hysteresis_plugins.exports.modes import part as part


def before(s: Array, p: Array, t: float, u: float) -> float:
    return arrived(s, p, t, u)

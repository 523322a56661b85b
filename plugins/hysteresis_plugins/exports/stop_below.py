"""An end stop below the output; constants: level, share, rounding."""

from __future__ import annotations

import math

from hysteresis_bench.arrays import Array
from hysteresis_plugins.exports.stop_above import part as part


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    short = p[0] - y
    return y + 0.5 * p[1] * (short + math.sqrt(short * short + p[2] * p[2]))

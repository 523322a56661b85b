"""Rayleigh's law beside the model; constants: coefficient.

State: started, first input, last input, value, depth, direction, then turning points and their values. More than KEPT
turning points that still count give NaN.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part

KEPT = 1024
TURN = 6
VALUE = TURN + KEPT


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    if s[0] == 0.0:
        s[0] = 1.0
        s[1] = u
        s[2] = u
    if u != s[2]:
        depth: int = int(s[4])
        heading = 1.0 if u > s[2] else -1.0
        if heading * s[5] < 0.0:
            if depth >= KEPT:
                return np.nan
            s[TURN + depth] = s[2]
            s[VALUE + depth] = s[3]
            depth += 1
        s[5] = heading
        while depth > 0:
            close = s[TURN + depth - 2] if depth > 1 else 2.0 * s[1] - s[TURN]
            if heading * (u - close) < 0.0:
                break
            depth = depth - 2 if depth > 2 else 0
        if depth == 0:
            s[3] = 0.5 * (u - s[1]) * abs(u - s[1])
        else:
            from_turn = u - s[TURN + depth - 1]
            s[3] = s[VALUE + depth - 1] + 0.25 * heading * (from_turn * from_turn)
        s[4] = depth * 1.0
        s[2] = u
    return y + p[0] * s[3]


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["coefficient"],), VALUE + KEPT) if p["coefficient"] != 0.0 else None

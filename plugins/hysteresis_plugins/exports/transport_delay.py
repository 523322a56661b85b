"""A delay: a ring of the last samples; state: count, place, then times and values.

A delay longer than KEPT samples gives NaN: a file without allocation keeps no more.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part

KEPT = 4096


def after(s: Array, p: Array, t: float, u: float, y: float) -> float:
    i: int = int(s[0])
    k: int = int(s[1])
    s[2 + i % KEPT] = t
    s[2 + KEPT + i % KEPT] = y
    s[0] = s[0] + 1.0
    then = t - p[0]
    if i - k >= KEPT:
        return np.nan
    while k < i and s[2 + (k + 1) % KEPT] <= then:
        k += 1
    s[1] = k * 1.0
    start = s[2 + k % KEPT]
    value = s[2 + KEPT + k % KEPT]
    if k == i or then <= start:
        return value
    share = (then - start) / (s[2 + (k + 1) % KEPT] - start)
    return value + share * (s[2 + KEPT + (k + 1) % KEPT] - value)


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part | None:
    return Part((p["delay"],), 2 + 2 * KEPT) if timed and p["delay"] > 0.0 else None

"""A column of time that a given rate stands in for: what it says, where that is another rate."""

from __future__ import annotations

import numpy as np
import pandas as pd

from hysteresis_bench.data.readers.numbers import number, seconds
from hysteresis_bench.data.units import converted
from hysteresis_bench.signals import INDEX

SAME = 0.01
"""Relative difference up to which two rates are one: a time is written with few digits, and its steps vary."""


def another_rate(cells: pd.Series, unit: str | None, decimal: str, rate: float) -> str:
    """A clause on the rate that a column of time says, beside the given one, Hz.

    Empty where both agree, where the column only counts samples, and where it says no rate: one of other texts, in an
    unknown unit, or of a clock that stands still. The usual step counts and the mean one: a clock may be coarse or
    rough, and begin anew for every record.
    """
    time = np.array([number(cell, decimal) for cell in cells], dtype=float)
    if not np.isfinite(time).any() and (since := seconds(cells)) is not None:
        time, unit = since[0], "s"
    steps = np.diff(time[np.isfinite(time)])
    forward = steps[steps >= 0.0]
    if unit == INDEX or not np.sum(forward) > 0.0:
        return ""
    if unit is None and np.all(forward == 1.0):  # 0, 1, 2, ... counts samples
        return ""
    try:
        forward = converted(forward, unit or "s", "s")
    except ValueError:
        return ""
    usual, whole = float(np.median(forward)), float(np.sum(forward))
    tick = float(np.min(forward[forward > 0.0])) if np.any(forward == 0.0) else 0.0  # of a coarse clock
    if abs(usual * rate - 1.0) <= SAME or abs(forward.size / rate - whole) <= max(SAME * whole, tick):
        return ""
    said = 1.0 / usual if usual > 0.0 else forward.size / whole
    return f"{rate:g} Hz as given in place of the column of time, which says {said:.4g} Hz"

"""The root of the mean square."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array


def rms(values: Array) -> float:
    """Of all values of an array, in their unit; NaN without any."""
    return float(np.sqrt(np.mean(np.square(values))))

"""White noise from differences: of a smooth signal a difference of high order leaves nothing, of noise all."""

from __future__ import annotations

from math import comb, sqrt
from statistics import NormalDist

import numpy as np

from hysteresis_bench.arrays import Array

MEDIAN = NormalDist().inv_cdf(0.75)
"""Of the absolute value of a standard normal variable."""


def white_noise_rms(values: Array, order: int) -> float:
    """RMS of the white noise on a smooth signal of even samples, unit of the values; 0 where they are too few.

    values : (samples,);  order : of the difference, at least 1; polynomials of a lower degree vanish
    From the median, which takes no notice of a few corners. The squared weights of a difference sum to C(2n, n).
    """
    left = np.diff(values, order)
    return float(np.median(np.abs(left))) / (MEDIAN * sqrt(comb(2 * order, order))) if left.size else 0.0

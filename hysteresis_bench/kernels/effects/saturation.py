"""Smooth saturation of a swarm's output, in place."""

from __future__ import annotations

import math

from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import exponential, logarithm


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def saturate(y: Array, inverse_level: Array, sharpness: Array) -> None:
    """y / (1 + |k y|^n)^(1/n) in place of y, k the inverse level, n the sharpness.

    y : float64[samples, swarm]        overwritten; NaN stays
    inverse_level : float64[swarm]     k >= 0, 1 / unit of y; 0: y to the last bit
    sharpness : float64[swarm]         n >= 1
    """
    samples, swarm = y.shape
    softness, level = 1.0 / sharpness, 1.0 / inverse_level
    for i in range(samples):
        for j in range(swarm):
            x = y[i, j]
            excess = abs(inverse_level[j] * x)
            within = excess <= 1.0
            # the powers of the smaller of excess and 1 / excess, so that none overflows
            least = excess if within else 1.0 / excess
            power = exponential(sharpness[j] * logarithm(least))
            folded = exponential(-logarithm(1.0 + power) * softness[j])
            bent = x * folded if within else math.copysign(folded, x) * level[j]
            y[i, j] = bent if x == x else x

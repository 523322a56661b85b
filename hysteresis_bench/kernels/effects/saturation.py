"""Smooth saturation of a swarm's output, in place."""

from __future__ import annotations

import math

from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import base_2_logarithm, base_2_logarithm_to_2, power_of_2

WHOLE = 8
"""Columns that go side by side; of what is left over, the samples do, or a vector would be left half empty."""


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _bent(x, inverse_level, level, sharpness, softness):  # type: ignore[no-untyped-def]
    excess = abs(inverse_level * x)
    # the power of the smaller of excess and 1 / excess, so that it does not overflow
    power = power_of_2(-sharpness * abs(base_2_logarithm(excess)))
    folded = power_of_2(-base_2_logarithm_to_2(1.0 + power) * softness)
    bent = x * folded if excess <= 1.0 else math.copysign(folded, x) * level
    return bent if x == x else x


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def saturate(y: Array, inverse_level: Array, sharpness: Array) -> None:
    """y / (1 + |k y|^n)^(1/n) in place of y, k the inverse level, n the sharpness.

    y : float64[samples, swarm]        overwritten; NaN stays
    inverse_level : float64[swarm]     k >= 0, 1 / unit of y; 0: y to the last bit
    sharpness : float64[swarm]         n >= 1
    """
    samples, swarm = y.shape
    softness, level = 1.0 / sharpness, 1.0 / inverse_level
    whole = swarm - swarm % WHOLE
    for i in range(samples):
        for j in range(whole):
            y[i, j] = _bent(y[i, j], inverse_level[j], level[j], sharpness[j], softness[j])
    for j in range(whole, swarm):
        column = y[:, j].copy()
        for i in range(samples):
            column[i] = _bent(column[i], inverse_level[j], level[j], sharpness[j], softness[j])
        for i in range(samples):
            y[i, j] = column[i]

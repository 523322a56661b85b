"""A straight line that bends to a level, the corner rounded as by Menegotto and Pinto [1].

[1] M. Menegotto, P. E. Pinto, IABSE Reports 13 (1973) 15.
"""

from __future__ import annotations

from numba import njit

from hysteresis_bench.kernels.elementary import base_2_logarithm, base_2_logarithm_to_2, power_of_2

LEAST = 1e-300
"""Least of what is raised to m."""


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def bent(x, m, root):  # type: ignore[no-untyped-def]
    """x / (1 + |x|^m)^(1/m), from |x|^m or its inverse so that no power overflows.  root : 1 over m"""
    size = abs(x)
    power = power_of_2(-m * abs(base_2_logarithm(max(size, LEAST))))
    level = min(size, 1.0) * power_of_2(-root * base_2_logarithm_to_2(1.0 + power))
    return level if x >= 0.0 else -level

"""Exponential and logarithm without a call or a branch, so that loops over them are vectorised.

A loop over a swarm takes a fifth of the time that it takes with those of `math`.
"""

from __future__ import annotations

import numpy as np
from numba import njit

TO_BASE_2 = 1.4426950408889634
LN2_HIGH, LN2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
"""Their sum is ln 2; a whole number up to 2000 times the first has no rounding."""
WHOLE = 6755399441055744.0
"""1.5 times 2^52: what is added to it is rounded to a whole number, which then stands in its lowest bits."""
MANTISSA, HALF_UP = 0x000FFFFFFFFFFFFF, 0x3FE0000000000000
ROOT_HALF = 0.7071067811865476


@njit(inline="always", error_model="numpy")
def exponential(x):  # type: ignore[no-untyped-def]
    """exp(x), relative error below 4e-16; cut at exp(-708) and exp(709)."""
    x = min(max(x, -708.0), 709.0)
    shifted = x * TO_BASE_2 + WHOLE
    whole = shifted - WHOLE
    r = (x - whole * LN2_HIGH) - whole * LN2_LOW  # |r| <= ln(2) / 2
    r2 = r * r
    r4 = r2 * r2
    low = (1.0 + r) + r2 * (1 / 2 + r * (1 / 6))
    middle = (1 / 24 + r * (1 / 120)) + r2 * (1 / 720 + r * (1 / 5040))
    high = (1 / 40320 + r * (1 / 362880)) + r2 * (1 / 3628800 + r * (1 / 39916800) + r2 * (1 / 479001600))
    power = (np.float64(shifted).view(np.int64) + np.int64(1023)) << np.int64(52)
    return (low + r4 * (middle + r4 * high)) * np.int64(power).view(np.float64)


@njit(inline="always", error_model="numpy")
def _logarithm_of(exponent, part):  # type: ignore[no-untyped-def]
    """ln(2^exponent part), ROOT_HALF <= part < 2 ROOT_HALF."""
    f = (part - 1.0) / (part + 1.0)  # |f| < 0.172
    z = f * f
    z2 = z * z
    z4 = z2 * z2
    low = (1 / 3 + z * (1 / 5)) + z2 * (1 / 7 + z * (1 / 9))
    high = (1 / 11 + z * (1 / 13)) + z2 * (1 / 15 + z * (1 / 17)) + z4 * (1 / 19 + z * (1 / 21))
    series = 2.0 * (f + f * (z * (low + z4 * high)))
    return exponent * LN2_HIGH + (series + exponent * LN2_LOW)


@njit(inline="always", error_model="numpy")
def logarithm(x):  # type: ignore[no-untyped-def]
    """ln(x) of a normal x > 0, error below 3e-16 max(1, |ln x|); about -709 for 0."""
    bits = np.float64(x).view(np.int64)
    part = np.int64((bits & np.int64(MANTISSA)) | np.int64(HALF_UP)).view(np.float64)  # 1/2 <= part < 1
    small = part < ROOT_HALF
    exponent = np.float64((bits >> np.int64(52)) - np.int64(1022)) - (1.0 if small else 0.0)
    part = part + part if small else part
    return _logarithm_of(exponent, part)


@njit(inline="always", error_model="numpy")
def logarithm_to_2(x):  # type: ignore[no-untyped-def]
    """ln(x) of 1 <= x <= 2, as `logarithm` to the last bit."""
    small = x < 2.0 * ROOT_HALF
    return _logarithm_of(0.0 if small else 1.0, x if small else 0.5 * x)

"""Duhem hysteresis of a swarm: what the output lags behind a curve, which fades along the input's path.

With T = tanh((u - centre) / width),

    y = slope u + height T - lag,    d lag = lost du + lost_height dT - rate lag |du|.

An increment is solved in closed form, with T a cubic in between that has its slope at both ends, and does not turn
back [1]: exact in lost, of fourth order in the increment over the width in lost_height.

[1] F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238: slopes up to 3 times the chord's are monotone.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, given_to_lanes, taken_in
from hysteresis_bench.kernels.elementary import exponential, exponential_less_1
from hysteresis_bench.kernels.lanes import LANES

SHORT = 0.5
"""Fading along an increment below which the means are taken from a series: the closed form cancels there."""
STEEPEST = 3.0
"""Slope of the cubic, over that of its chord, up to which it does not turn back [1]."""

# Rows of a group: the parameters as in `duhem`; then the input, the input before, T and its slope, the lag, y.
RATE, CENTRE, WIDTH, SLOPE, HEIGHT, LOST, LOST_HEIGHT = (row * LANES for row in range(7))
NOW, BEFORE, T, STEEP, LAG, Y = (row * LANES for row in range(7, 13))
ROWS = 13


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def tanh_of(x):  # type: ignore[no-untyped-def]
    faded = exponential_less_1(-2.0 * abs(x))
    size = -faded / (2.0 + faded)
    return size if x >= 0.0 else -size


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def means(x):  # type: ignore[no-untyped-def]
    """Integrals from 0 to 1 over s of s^0, s^1 and s^2 times exp(-x (1 - s)), and exp(-x); x >= 0."""
    short = min(x, SHORT)
    x2 = short * short
    x4 = x2 * x2
    low = (1 / 3 - short * (1 / 12)) + x2 * (1 / 60 - short * (1 / 360))
    middle = (1 / 2520 - short * (1 / 20160)) + x2 * (1 / 181440 - short * (1 / 1814400))
    high = (1 / 19958400 - short * (1 / 239500800)) + x2 * (1 / 3113510400 - short * (1 / 43589145600))
    series = low + x4 * (middle + x4 * high)  # of 2 (-x)^k / (k + 3)!
    first = 0.5 * (1.0 - short * series)
    mean = 1.0 - short * first
    long = max(x, SHORT)
    faded = exponential(-long)
    mean_long = (1.0 - faded) / long
    first_long = (1.0 - mean_long) / long
    second_long = (1.0 - 2.0 * first_long) / long
    is_short = x < SHORT
    return (
        mean if is_short else mean_long,
        first if is_short else first_long,
        series if is_short else second_long,
        1.0 - short * mean if is_short else faded,
    )


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _moved_together(s: Array) -> None:
    """A group, one increment on."""
    for j in range(min(LANES, s.size & -LANES)):
        now = s[NOW + j]
        step = now - s[BEFORE + j]
        t = tanh_of((now - s[CENTRE + j]) / s[WIDTH + j])
        steep = (1.0 - t * t) / s[WIDTH + j]
        chord = t - s[T + j]
        way, most = abs(step), STEEPEST * abs(chord)
        begins, ends = min(s[STEEP + j] * way, most), min(steep * way, most)
        sign = 1.0 if step >= 0.0 else -1.0
        mean, first, second, faded = means(s[RATE + j] * way)
        along = begins * (mean - 4.0 * first + 3.0 * second) + ends * (3.0 * second - 2.0 * first)
        curve = sign * along + 6.0 * chord * (first - second)
        s[LAG + j] = faded * s[LAG + j] + s[LOST + j] * step * mean + s[LOST_HEIGHT + j] * curve
        s[BEFORE + j], s[T + j], s[STEEP + j] = now, t, steep
        s[Y + j] = s[SLOPE + j] * now + s[HEIGHT + j] * t - s[LAG + j]


@njit(cache=True, error_model="numpy")
def duhem(u: Array, parameters: Array, y: Array) -> None:
    """The output y, on the curve at the first sample.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    parameters : float64[7, swarm]    rate >= 0, over the unit of u; centre and width > 0, unit of u; slope, unit of y
        over that of u; height, unit of y; lost, unit of y over that of u; lost_height, unit of y
    y : float64[samples, swarm]    overwritten with the output
    """
    samples, swarm = y.shape
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        given_to_lanes(s, parameters, first, used)
        taken_in(s, BEFORE, u, 0, first, used)
        for j in range(LANES):
            s[T + j] = tanh_of((s[BEFORE + j] - s[CENTRE + j]) / s[WIDTH + j])
            s[STEEP + j] = (1.0 - s[T + j] * s[T + j]) / s[WIDTH + j]
        for i in range(samples):
            taken_in(s, NOW, u, i, first, used)
            _moved_together(s)
            given_out(s, Y, y, i, first, used)

"""What several formulas share that hide an effect in made data: linear stages on a fine grid, without the kernels."""

from __future__ import annotations

from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Hiding

LONGEST = 0.2
"""Longest lag or delay, in periods of the fastest drive."""


def longest_lag(hiding: Hiding) -> float:
    """Time constant or delay of the first form, unit of time."""
    return LONGEST / hiding.fastest * hiding.strength


def middling_lag(hiding: Hiding) -> float:
    """Time constant or delay of the second form, unit of time: a tenth to a third of a radian."""
    return (0.1 + 0.25 * hiding.strength) / (2 * np.pi * hiding.fastest)


def euler_lag(x: Array, constant: float, step: float) -> Array:
    """First order, explicit Euler with the mean of both ends."""
    share, state = step / max(constant, step), float(x[0])
    out = np.empty_like(x)
    out[0] = state
    for k in range(1, x.size):
        state += share * (0.5 * (x[k] + x[k - 1]) - state)
        out[k] = state
    return out


def unequal_lag(x: Array, rising: float, falling: float, step: float) -> Array:
    """First order, with one time constant where the answer rises and another one where it falls."""
    up, down, state = step / max(rising, step), step / max(falling, step), float(x[0])
    out = np.empty_like(x)
    out[0] = state
    for k in range(1, x.size):
        behind = 0.5 * (x[k] + x[k - 1]) - state
        state += (up if behind > 0.0 else down) * behind
        out[k] = state
    return out


def level_lag(x: Array, constant: float, level: float, step: float) -> Array:
    """First order, its time constant half as long at 0 and three halves as long at a level to either side."""
    state = float(x[0])
    out = np.empty_like(x)
    out[0] = state
    for k in range(1, x.size):
        here = constant * (0.5 + min(abs(state / level), 2.0))
        state += step / max(here, step) * (0.5 * (x[k] + x[k - 1]) - state)
        out[k] = state
    return out


def tustin_lag(x: Array, constant: float, step: float) -> Array:
    """First order, Tustin's rule."""
    return tustin(x, [1.0], [constant, 1.0], step)


def tustin(x: Array, numerator: list[Any], denominator: list[Any], step: float) -> Array:
    """A transfer function by Tustin's rule, from its equilibrium with the first sample."""
    from scipy.signal import bilinear, lfilter, lfilter_zi

    b, a = bilinear(numerator, denominator, 1.0 / step)
    filtered: Array = lfilter(b, a, x, zi=lfilter_zi(b, a) * x[0])[0]
    return filtered


def path(drive: Array) -> Array:
    """Length of the path since the first sample, same shape."""
    travelled: Array = np.append(0.0, np.cumsum(np.abs(np.diff(drive))))
    return travelled

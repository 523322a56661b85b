"""What a second-order lag is before the hysteresis and after it: its parameters, box and step, and how data hide it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Hiding
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record
from hysteresis_plugins.effects._hidden import euler_lag, longest_lag, tustin
from hysteresis_plugins.effects._ranges import FINEST, finest_step, longest

PEAKED = 1.0 / np.sqrt(2.0)
"""Damping ratio up to which the gain of a second-order stage has a peak at some frequency: there it can resonate."""

APART = 2.0
"""Damping ratio up to which both lags are to be seen: there the slower is 14 times the faster. With half of it they
are equal; with twice it they are 62 times apart, and the faster leaves no trace where the slower lets any through."""

PARAMETERS = (
    Parameter("time_constant", 1e-4, 10.0, "{time}", "log", null=0.0, meaning="sum of both lags' time constants"),
    Parameter("damping", PEAKED, APART, scaling="log", meaning="damping ratio; 1: two equal lags"),
)


def late(time: Array, values: Array, p: Any) -> Array:
    """What arrives of a signal, (samples, swarm)."""
    from hysteresis_bench.kernels.second_order import second_order

    with np.errstate(divide="ignore"):
        omega = 2.0 * p.damping / p.time_constant
    return second_order(time, values, 2.0 * p.damping * omega, omega**2)


def box(records: Sequence[Record]) -> tuple[Parameter, ...]:
    """Time constants from a fiftieth of a sampling step to the duration of the longest record."""
    time_constant, damping = PARAMETERS
    return time_constant.within(FINEST * finest_step(records), longest(records)), damping


def two_equal(x: Array, hiding: Hiding) -> Array:
    """Two equal lags in series."""
    half = 0.5 * longest_lag(hiding)
    return euler_lag(euler_lag(x, half, hiding.step), half, hiding.step)


def butterworth(x: Array, hiding: Hiding) -> Array:
    """An instrument's filter of second order, of the flattest gain."""
    return _filtered(x, [PEAKED], [], hiding)


def third_butterworth(x: Array, hiding: Hiding) -> Array:
    """... and of third order: one pair of poles of damping 1/2, and one lag."""
    return _filtered(x, [0.5], [1.0], hiding)


def three_apart(x: Array, hiding: Hiding) -> Array:
    """Three lags in series, each half the one before."""
    for share in (4.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0):
        x = euler_lag(x, share * longest_lag(hiding), hiding.step)
    return x


def moving_average(x: Array, hiding: Hiding) -> Array:
    """The mean of what has been since twice the longest lag, by the trapezoidal rule."""
    half = longest_lag(hiding)
    total = np.concatenate([[0.0], np.cumsum(0.5 * (x[1:] + x[:-1]) * hiding.step)])
    before = hiding.time - 2.0 * half
    earlier = np.interp(before, hiding.time, total) + np.minimum(before - hiding.time[0], 0.0) * x[0]
    mean: Array = (total - earlier) / (2.0 * half)
    return mean


def _filtered(x: Array, dampings: Sequence[float], lags: Sequence[float], hiding: Hiding) -> Array:
    """Stages of one natural frequency in series, of these dampings, and lags that many times its inverse; in all as
    late as the longest lag."""
    inverse = longest_lag(hiding) / (2.0 * sum(dampings) + sum(lags))
    for damping in dampings:
        x = tustin(x, [1.0], [inverse**2, 2.0 * damping * inverse, 1.0], hiding.step)
    for lag in lags:
        x = tustin(x, [1.0], [lag * inverse, 1.0], hiding.step)
    return x

"""The rate of the input, for what acts beside the law with it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Record
from hysteresis_plugins.effects._ranges import motionless, one_frequency, without_time


def rate(time: Array, u: Array) -> Array:
    """Of an input that is linear between its samples, the mean over what lies between the samples before and after:
    the central difference;  u : (samples, columns) -> the same shape, unit of u over unit of time"""
    v = np.empty_like(u)
    v[1:-1] = (u[2:] - u[:-2]) / (time[2:] - time[:-2])[:, None]
    v[:1], v[-1:] = (u[1:2] - u[:1]) / (time[1] - time[0]), (u[-1:] - u[-2:-1]) / (time[-1] - time[-2])
    return v


def without_rates(records: Sequence[Record]) -> str:
    """The reason against forces of the rate, or an empty string."""
    if reason := without_time(records) or motionless(records):
        return reason
    if one_frequency(records):
        return "at the one frequency of these records damping makes a loop round, as a law may"
    return ""

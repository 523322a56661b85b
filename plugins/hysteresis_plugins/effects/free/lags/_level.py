"""What the free forms share that lag with a time constant of its own at every level."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, read_only
from hysteresis_plugins.effects._ranges import longest
from hysteresis_plugins.effects.free._spline import POINTS, narrow

CONSTANTS = ("lowest", "low", "middle", "high", "highest")
"""Levels at which there is a time constant, in the order of the kernel."""

RANGES = ("bottom", "top")

ACCURACY = 2e-4
"""Of the kernel, which cuts steps by an estimate of the error."""

LONGEST = 0.25
"""Of the longest record, the longest time constant."""


def parameters(unit: str) -> tuple[Parameter, ...]:
    """unit : of what lags"""
    return (
        Parameter("bottom", -2.0, -1.0, unit, meaning="the lowest level"),
        Parameter("top", 1.0, 2.0, unit, meaning="the highest level"),
        *(
            Parameter(f"time_constant_{name}", 0.0, 10.0, "{time}", null=0.0, meaning=f"at the {name} level")
            for name in CONSTANTS
        ),
    )


def constants(p: Any) -> Array:
    """(5, swarm)"""
    return np.stack([getattr(p, f"time_constant_{name}") for name in CONSTANTS])


def behind(time: Array, values: Array, p: Any) -> Array:
    """What follows a signal, (samples, swarm)."""
    from hysteresis_bench.kernels.lag_with_level import lag_with_level

    return lag_with_level(time, read_only(values), p.bottom, p.top, constants(p))


def box(own: Sequence[Parameter], records: Sequence[Record], low: float, high: float) -> tuple[Parameter, ...]:
    """low, high : the range of what lags"""
    bottom, top, *others = own
    span = (high - low) or 1.0
    return (
        narrow(bottom, low, span),
        narrow(top, high, span),
        *(one.within(0.0, LONGEST * longest(records)) for one in others),
    )


def curve(p: Any, of: str, unit: str) -> Curve:
    levels = np.linspace(p.bottom, p.top, len(CONSTANTS))
    level = np.linspace(p.bottom, p.top, POINTS)
    return Curve(level, np.interp(level, levels, constants(p)), f"level of {of}", "time constant", unit, "{time}")

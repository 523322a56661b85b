"""What the free forms share that lag by a curve of the rate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, read_only
from hysteresis_plugins.effects._ranges import fastest, longest
from hysteresis_plugins.effects.free._spline import POINTS

CONSTANTS = ("falling_fast", "falling", "rising", "rising_fast")
"""Time constants, in the order of the kernel."""

BEYOND = ("falling_fast", "rising_fast")
"""Those beyond the bend."""

LIMITS = ("bend", *BEYOND)
"""Without a bend within the rates of the data, or with a rate that is never passed."""

SLOWEST = 0.02
"""Of the fastest movement, the slowest at which the curve may bend."""

LONGEST, STEEPEST = 0.25, 10.0
"""Of the longest record, the longest time constant, and that beyond the bend: with it nothing moves faster than there,
as behind a limited slew rate. Up to 0.25, one that is limited in a closed loop was left at 2 to 5 times the noise."""


def parameters(unit: str) -> tuple[Parameter, ...]:
    """unit : of what lags"""
    slopes = ("falls beyond the bend", "falls", "rises", "rises beyond the bend")
    return (
        Parameter(
            "bend", 0.01, 100.0, f"{unit}/{{time}}", "log", meaning="rate at which the curve bends", positive=True
        ),
        *(
            Parameter(name, 0.0, 10.0, "{time}", null=0.0, meaning=f"time constant where what follows {slope}")
            for name, slope in zip(CONSTANTS, slopes, strict=True)
        ),
    )


def constants(p: Any) -> Array:
    """(4, swarm)"""
    return np.stack([getattr(p, name) for name in CONSTANTS])


def behind(time: Array, values: Array, p: Any) -> Array:
    """What follows a signal, (samples, swarm)."""
    from hysteresis_bench.kernels.lag_curve import lag_curve

    return lag_curve(time, read_only(values), p.bend, constants(p))


def box(own: Sequence[Parameter], records: Sequence[Record], unit: float) -> tuple[Parameter, ...]:
    """unit : of what lags, in units of the input"""
    bend, *slopes = own
    top = unit * fastest(records)
    duration = longest(records)
    most = {one.name: duration * (STEEPEST if one.name in BEYOND else LONGEST) for one in slopes}
    return bend.within(SLOWEST * top, top), *(one.within(0.0, most[one.name]) for one in slopes)


def curve(p: Any, of: str, unit: str) -> Curve:
    """Of one set of parameters, up to twice the rate at which it bends."""
    rate = p.bend * np.linspace(-2.0, 2.0, POINTS)
    slow, fast = np.clip(rate, -p.bend, p.bend), rate - np.clip(rate, -p.bend, p.bend)
    falls = rate < 0.0
    distance = slow * np.where(falls, p.falling, p.rising) + fast * np.where(falls, p.falling_fast, p.rising_fast)
    return Curve(rate, distance, "rate", f"distance that {of} is behind", f"{unit}/{{time}}", unit)

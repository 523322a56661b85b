"""What the free forms share that lag with a time constant of its own at every level."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, read_only
from hysteresis_plugins.effects._ranges import finest_step, longest
from hysteresis_plugins.effects.free._spline import POINTS, narrow

LEVELS = ("lowest", "low", "middle", "high", "highest")
"""At which there is a time constant, in the order of the kernel."""

MOST = 4.0
"""Times the time constant in the middle, and a share of it, up to which it goes elsewhere."""

RANGES = ("bottom", "top")
LIMITS = tuple(f"at_{name}" for name in LEVELS if name != "middle")

ACCURACY = 5e-3
"""Of the kernel, on steps of a tenth of the range: it cuts them by an estimate of the error."""

STARTS = 9
"""Time constants from which a search begins, with the longest one: where the lag is none, its levels have no slope."""

LONGEST = 0.25
"""Of the longest record, the longest time constant."""


def parameters(unit: str) -> tuple[Parameter, ...]:
    """unit : of what lags"""
    return (
        Parameter("bottom", -2.0, -1.0, unit, meaning="the lowest level"),
        Parameter("top", 1.0, 2.0, unit, meaning="the highest level"),
        Parameter("time_constant", 0.0, 10.0, "{time}", null=0.0, meaning="in the middle of the levels"),
        *(
            Parameter(f"at_{name}", 1.0 / MOST, MOST, "1", "log", null=1.0, meaning=f"{name} level, over the middle")
            for name in LEVELS
            if name != "middle"
        ),
    )


def constants(p: Any) -> Array:
    """(5, swarm)"""
    shares = [1.0 if name == "middle" else getattr(p, f"at_{name}") for name in LEVELS]
    return np.stack([p.time_constant * share for share in shares])


def behind(time: Array, values: Array, p: Any) -> Array:
    """What follows a signal, (samples, swarm)."""
    from hysteresis_bench.kernels.lag_with_level import lag_with_level

    return lag_with_level(time, read_only(values), p.bottom, p.top, constants(p))


def box(own: Sequence[Parameter], records: Sequence[Record], low: float, high: float) -> tuple[Parameter, ...]:
    """low, high : the range of what lags"""
    bottom, top, time_constant, *others = own
    span = (high - low) or 1.0
    return (
        narrow(bottom, low, span),
        narrow(top, high, span),
        time_constant.within(0.0, LONGEST * longest(records)),
        *others,
    )


def starts(records: Sequence[Record]) -> list[dict[str, float]]:
    """One time constant at all levels, from a sampling step on."""
    known = {f"at_{name}": 1.0 for name in LEVELS if name != "middle"}
    times = np.geomspace(finest_step(records), LONGEST * longest(records), STARTS)
    return [{"time_constant": float(time), **known} for time in times[:-1]]


def curve(p: Any, of: str, unit: str) -> Curve:
    levels = np.linspace(p.bottom, p.top, len(LEVELS))
    level = np.linspace(p.bottom, p.top, POINTS)
    return Curve(level, np.interp(level, levels, constants(p)), f"level of {of}", "time constant", unit, "{time}")

"""What the free forms of linear dynamics share: lags on a logarithmic grid of time constants."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record
from hysteresis_plugins.effects._ranges import finest_step, longest
from hysteresis_plugins.effects.free._spline import POINTS, narrow

LAGS = 7
MOST = 3.0
"""Largest weight: two equal lags in series are two near ones of opposite weights."""

RANGES = ("shortest", "longest")
PARAMETERS = (
    Parameter("shortest", 1e-3, 0.1, "{time}", meaning="time constant of the first lag", positive=True),
    Parameter("longest", 1.0, 100.0, "{time}", meaning="time constant of the last lag", positive=True),
    *(Parameter(f"weight{k}", -MOST, MOST, null=0.0, meaning=f"of lag {k}") for k in range(1, LAGS + 1)),
)


def constants(p: Any) -> Array:
    """(lags, swarm)"""
    place = np.linspace(0.0, 1.0, LAGS).reshape(-1, *([1] * np.ndim(p.shortest)))
    grid: Array = p.shortest * (p.longest / p.shortest) ** place
    return grid


def weights(p: Any) -> Array:
    """(lags, swarm)"""
    return np.stack([getattr(p, f"weight{k}") for k in range(1, LAGS + 1)])


def late(time: Array, values: Array, p: Any, out: Array | None = None) -> Array:
    """What arrives of a signal, (samples, swarm); out : as in `weighted_lags`"""
    from hysteresis_bench.kernels.lag import weighted_lags

    return weighted_lags(time, values, weights(p), constants(p), out)


def box(records: Sequence[Record]) -> tuple[Parameter, ...]:
    """Time constants from half a sampling step to the duration of the longest record."""
    shortest, last, *others = PARAMETERS
    return narrow(shortest, 0.5 * finest_step(records)), narrow(last, longest(records)), *others


def step_response(p: Any, of: str) -> Curve:
    time = np.geomspace(p.shortest, p.longest, POINTS)
    answer = 1.0 - weights(p) @ np.exp(-time / constants(p)[:, None])
    return Curve(time, answer, "time since a step", f"{of} after a step", "{time}", logarithmic=True)

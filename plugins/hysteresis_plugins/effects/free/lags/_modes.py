"""What the free forms share that are modes: two stages of second order beside a direct path."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, read_only
from hysteresis_plugins.effects._ranges import finest_step
from hysteresis_plugins.effects.resonance import fastest_period

MODES = (1, 2)

MOST = 3.0
"""Largest weight: two near modes of opposite weights are an antiresonance between them. With half
and twice of it four made transfer functions end alike (1.00 to 1.02 times the noise), and so with LEADING, STARTS and
DAMPING."""

LEADING = 2.0
"""Largest part of the velocity, over the natural angular frequency: of a mount with critical damping it is 2."""

DECADE = 10.0
"""Times the highest natural frequency, and a part of the lowest, between which the gain is drawn."""

POINTS = 241
"""Of the drawn gain: a peak is about as wide as its frequency times twice its damping."""

STARTS, DAMPING = 5, 0.2
"""Periods of the slower mode from which a search begins, each with a faster mode of half of it, and the damping ratio
of both."""


def _parameters(k: int) -> tuple[Parameter, ...]:
    return (
        Parameter(f"period{k}", 1e-4, 1.0, "{time}", "log", meaning=f"1 / undamped natural frequency of mode {k}"),
        Parameter(f"damping{k}", 0.02, 2.0, scaling="log", meaning=f"damping ratio of mode {k}"),
        Parameter(f"weight{k}", -MOST, MOST, null=0.0, meaning=f"of mode {k}"),
        Parameter(f"lead{k}", -LEADING, LEADING, null=0.0, meaning=f"part of its velocity that mode {k} is ahead by"),
    )


PARAMETERS = tuple(one for k in MODES for one in _parameters(k))


def stage(p: Any, k: int) -> tuple[Any, Any, Any]:
    """Damping in 1/s, stiffness in 1/s², and lead in s, of a mode, where time is in s; each as in p."""
    omega = 2.0 * np.pi / getattr(p, f"period{k}")
    return 2.0 * getattr(p, f"damping{k}") * omega, omega**2, getattr(p, f"lead{k}") / omega


def weights(p: Any) -> list[Any]:
    """Each as in p."""
    return [getattr(p, f"weight{k}") for k in MODES]


def passed(time: Array, values: Array, p: Any) -> Array:
    """What arrives of a signal, (samples, swarm)."""
    from hysteresis_bench.kernels.second_order import leading_second_order

    values = read_only(values)
    arrived = np.repeat(values, p.period1.size // values.shape[1], axis=1)
    for k, weight in zip(MODES, weights(p), strict=True):
        arrived += weight * (leading_second_order(time, values, *stage(p, k)) - values)
    return arrived


def box(records: Sequence[Record]) -> tuple[Parameter, ...]:
    """Periods from two sampling steps to twice the one in which the fastest record runs through its range."""
    lower, upper = 2.0 * finest_step(records), 2.0 * fastest_period(records)
    return tuple(
        one.within(min(lower, 0.5 * upper), upper) if one.name.startswith("period") else one for one in PARAMETERS
    )


def starts(records: Sequence[Record]) -> list[dict[str, float]]:
    """Most of the motion in the slower mode; or a little of it, beside the direct path."""
    slowest = box(records)[0]
    periods = np.geomspace(slowest.upper, 2.0 * slowest.lower, STARTS)
    return [
        {
            "period1": float(period), "damping1": DAMPING, "weight1": weight, "lead1": 0.0,
            "period2": 0.5 * float(period), "damping2": DAMPING, "weight2": 0.1, "lead2": 0.0,
        }
        for period, weight in product(periods, (0.9, 0.2))
    ]  # fmt: skip


def frequency_response(p: Any) -> Curve:
    """Its gain, of one set of parameters."""
    periods = [getattr(p, f"period{k}") for k in MODES]
    frequency = np.geomspace(1.0 / (DECADE * max(periods)), DECADE / min(periods), POINTS)
    total = np.ones(POINTS, complex)
    for k, period, weight in zip(MODES, periods, weights(p), strict=True):
        ratio = frequency * period
        ahead = 1.0 + 1j * getattr(p, f"lead{k}") * ratio
        total += weight * (ahead / (1.0 - ratio**2 + 2j * getattr(p, f"damping{k}") * ratio) - 1.0)
    return Curve(frequency, np.abs(total), "frequency", "gain", "1/{time}", logarithmic=True)

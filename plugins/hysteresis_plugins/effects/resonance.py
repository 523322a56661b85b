"""Resonance: the output passes a mass, a spring and a damper."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import tustin
from hysteresis_plugins.effects._ranges import one_frequency
from hysteresis_plugins.effects._second_order import PEAKED


def _semi_implicit(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A mass on a spring and damper, semi-implicit Euler in ten parts of a step."""
    x = inner(u)
    omega = 2.0 * np.pi / (0.08 / hiding.fastest + 0.72 / hiding.fastest * hiding.strength)
    damping, part = 0.1 + 0.4 * hiding.random[0], hiding.step / 10.0
    out, place, speed = np.empty_like(x), float(x[0]), 0.0
    out[0] = place
    for k in range(1, x.size):
        for j in range(10):
            target = x[k - 1] + (x[k] - x[k - 1]) * (j + 0.5) / 10.0
            speed += part * (omega**2 * (target - place) - 2.0 * damping * omega * speed)
            place += part * speed
        out[k] = place
    return out


def _tustin(inner: Response, u: Array, hiding: Hiding) -> Array:
    natural = 2 * np.pi * hiding.fastest * (3.0 + 3.0 * (1.0 - hiding.strength))
    damping = 0.05 + 0.25 * hiding.random[0]
    return tustin(inner(u), [natural**2], [1.0, 2.0 * damping * natural, natural**2], hiding.step)


def _hardening(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A mass on a spring that stiffens with the deflection, semi-implicit Euler."""
    x = inner(u)
    omega = 2.0 * np.pi / (0.72 / hiding.fastest * hiding.strength + 4.0 * hiding.step)
    damping, stiffer = 0.1 + 0.4 * hiding.random[0], 0.3 / max(hiding.top**2, 1e-300)
    part, place, speed = hiding.step / 10.0, float(x[0]), 0.0
    out = np.empty_like(x)
    out[0] = place
    for k in range(1, x.size):
        for j in range(10):
            away = x[k - 1] + (x[k] - x[k - 1]) * (j + 0.5) / 10.0 - place
            speed += part * (omega**2 * away * (1.0 + stiffer * away**2) - 2.0 * damping * omega * speed)
            place += part * speed
        out[k] = place
    return out


def _two_modes(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Two modes beside each other, four fifths of the motion in the lower one."""
    x, low = inner(u), 2.0 * np.pi / (0.72 / hiding.fastest * hiding.strength + 4.0 * hiding.step)
    damping = 0.1 + 0.3 * hiding.random[0]
    modes = [tustin(x, [omega**2], [1.0, 2.0 * damping * omega, omega**2], hiding.step) for omega in (low, 2.2 * low)]
    return 0.8 * modes[0] + 0.2 * modes[1]


@dataclass(frozen=True)
class Resonance(Effect):
    """A second-order lag of the output with unit static gain, which can resonate.

    y'' + 2 damping omega y' + omega² y = omega² x, omega = 2 pi / period, exact for an output x that is linear
    between its samples, from static equilibrium with the first one.

    The period switches the effect, rather than the frequency: its null 0 is reached continuously, as the
    lag vanishes with it.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "transport-delay": "far below its natural frequency a damped resonance only delays",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_semi_implicit, _tustin)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_hardening, _two_modes)
    parameters = (
        Parameter("period", 0.0, 0.1, unit="{time}", null=0.0, meaning="1 / undamped natural frequency"),
        Parameter("damping", 0.02, 2.0, scaling="log", meaning="damping ratio, 1 is critical"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.second_order import second_order

        output = inner(signal)
        if not signal.timed:
            return output
        with np.errstate(divide="ignore"):
            omega = 2.0 * np.pi / p.period
        return second_order(signal.time, output, 2.0 * p.damping * omega, omega**2)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Periods up to twice the one in which the fastest record runs through its range: a slower stage
        would not have let it through. Damping up to where the gain has a peak: beyond that it is a
        `second-order-lag`."""
        period, damping = self.parameters
        return period.within(0.0, 2.0 * fastest_period(records)), damping.within(damping.lower, PEAKED)

    def inapplicable(self, records: Sequence[Record]) -> str:
        if not all(record.timed for record in records):
            return "the time of these records is only an index"
        if all(float(np.ptp(record.input)) == 0.0 for record in records):
            return "the input never moves"
        if one_frequency(records):
            return "at the one frequency of these records a resonance is a delay and a gain, which lag and model have"
        return ""


def fastest_period(records: Sequence[Record]) -> float:
    """Shortest mean period of the records, s: twice the span over the mean speed of the input, which of a
    sine is its period."""
    periods = []
    for record in records:
        path = float(np.sum(np.abs(np.diff(record.input))))
        duration = float(record.time[-1] - record.time[0])
        periods.append(2.0 * float(np.ptp(record.input)) / path * duration if path > 0.0 else duration)
    return min(periods)

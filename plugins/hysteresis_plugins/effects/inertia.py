"""Inertia: beside the hysteresis a mass is moved, whose force goes with the second derivative of the input."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import motionless, one_frequency, output_span, without_time
from hysteresis_plugins.effects._rate import rate


def _acceleration(u: Array, hiding: Hiding) -> Array:
    """Over that of the fastest drive at the largest amplitude."""
    most = (2.0 * np.pi * hiding.fastest) ** 2 * hiding.amplitude
    return np.asarray(np.gradient(np.gradient(u, hiding.step), hiding.step) / most)


def _mass(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + 0.3 * hiding.strength * abs(hiding.top) * _acceleration(u, hiding)


def _elsewhere(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Between the specimen and a sensor on the other side: the sensor feels the mass with the other sign."""
    return inner(u) - 0.3 * hiding.strength * abs(hiding.top) * _acceleration(u, hiding)


@dataclass(frozen=True)
class Inertia(Effect):
    """Between what is moved and what measures its force lies a mass, such as a fixture or half of a load cell [1].

    y = x + mass d2u/dt2, x the response. The mass is below 0 where the sensor stands on the other side of the specimen.
    It turns no loop either way: it tilts it, and the more the faster it is run.

    Ours: the acceleration at a sample is the central difference of rates that are central differences, a quarter as
    loud as the second difference where the measured input is noisy. A line through samples has none but at its corners,
    so more samples of the same line have another one.

    [1] ISO 4965-1:2012, Metallic materials, Dynamic force calibration for uniaxial fatigue testing: inertial error.
    """

    acts = "law"
    family = "inertia beside the law"
    affine = True
    linear = ("mass",)
    accuracy = float("inf")
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "resonance": "slow against its frequency a resonance adds a part that goes with the acceleration",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_mass, _elsewhere)
    parameters = (
        Parameter("mass", -1.0, 1.0, "{output} {time}^2/{input}", null=0.0, meaning="force over the acceleration"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        if not signal.timed or signal.time.size < 3 or not np.any(p.mass):
            return output
        return np.asarray(output + p.mass * rate(signal.time, rate(signal.time, signal.input)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to what makes the output's range at the largest acceleration."""
        most = (output_span(records) or 1.0) / (max(map(_largest, records)) or 1.0)
        return (self.parameters[0].within(-most, most),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        if reason := without_time(records) or motionless(records):
            return reason
        if one_frequency(records):
            return "at the one frequency of these records a mass is a spring of the other sign"
        return ""


def _largest(record: Record) -> float:
    """Acceleration of the input; all but a hundredth of the samples have less."""
    found = rate(record.time, rate(record.time, record.input[:, None]))
    return float(np.quantile(np.abs(found), 0.99))

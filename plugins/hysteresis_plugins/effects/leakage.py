"""Leakage: charge that flows through the device is integrated with its polarization."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import motionless, one_frequency, output_span, without_time


def _integral(time: Array, u: Array) -> Array:
    """Integral of u over time by trapezoids, from the first sample; u : (samples, columns) -> the same shape."""
    total = np.zeros_like(u)
    np.cumsum(0.5 * (u[1:] + u[:-1]) * np.diff(time)[:, None], axis=0, out=total[1:])
    return total


def _strength(hiding: Hiding) -> float:
    """Output a unit of time at the largest input: the same in every record, as the resistor is."""
    return 20.0 * hiding.strength * hiding.top / hiding.duration


def _summed(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Charge counted up sample by sample."""
    return inner(u) + _strength(hiding) * np.cumsum(u / hiding.amplitude) * hiding.step


def _sinh(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Hopping conduction: the current rises with the hyperbolic sine of the input."""
    return inner(u) + _strength(hiding) * np.cumsum(np.sinh(2.0 * u / hiding.amplitude)) * hiding.step


def _cubic(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Space-charge limited: mostly with the cube of the input."""
    drive = u / hiding.amplitude
    return inner(u) + _strength(hiding) * np.cumsum(drive * (0.3 + drive**2)) * hiding.step


@dataclass(frozen=True)
class Leakage(Effect):
    """A resistor across the device: the output collects conductance times the integral of the input over time.

    y = x + conductance * integral of u dt from the record's first sample, x the response: what a charge or polarization
    that was found by integrating a current owes to conduction [1]. The loop gets rounder, and open, the more slowly it
    is run. Ours: ohmic, by trapezoids.

    [1] H. Yan, F. Inam, G. Viola, H. Ning, H. Zhang, Q. Jiang, T. Zeng, Z. Gao, M. J. Reece, J. Adv. Dielectrics 1
        (2011) 107.
    """

    acts = "added"
    family = "change with time, path or temperature"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "drift": "with an input that is not centred at 0 both let the output run away steadily",
        "creep": "both let the output go on while the input holds",
        "input-lag": "where frequencies differ little both add a part that is a quarter of a period late",
        "output-lag": "where frequencies differ little both add a part that is a quarter of a period late",
        "transport-delay": "where frequencies differ little both add a part that is a quarter of a period late",
    }
    affine = True
    linear = ("conductance",)
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_summed,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_sinh, _cubic)
    parameters = (Parameter("conductance", -1.0, 1.0, "{output}/({input} {time})", null=0.0, meaning="of what leaks"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.curve_in_time import add

        output = inner(signal)
        if not signal.timed or not np.any(p.conductance):
            return output
        leaked = _integral(signal.time, signal.input)
        if leaked.shape[1] > 1:
            summed: Array = output + leaked * p.conductance
            return summed
        output = own(output, signal)
        add(output, leaked[:, 0], p.conductance)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to what would collect twice the range of the output."""
        spans = [np.ptp(_integral(record.time, record.input[:, None])) for record in records]
        most = 2.0 * (output_span(records) or 1.0) / (float(max(spans)) or 1.0)
        return (self.parameters[0].within(-most, most),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        if reason := without_time(records) or motionless(records):
            return reason
        if one_frequency(records):
            return "at the one frequency of these records leakage is a delay and a drift, which other effects have"
        return ""

"""Clock error: output and input were recorded by two clocks, one of which runs slow."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import dominant_frequency, longest, unresolved

LONGEST = 0.25
"""Of the slowest record's period, by which the clocks may be apart at the end of the longest record. Four made cases
with a clock that is 0.4 % off come out the same with half and with twice of it."""


def _late(hiding: Hiding) -> float:
    """By how much at the end of the longest record, unit of time: up to two thirds of a radian of the fastest drive."""
    return (0.1 + 0.9 * hiding.strength) * hiding.strength / (3.0 * np.pi * hiding.fastest)


def _shown(inner: Response, u: Array, hiding: Hiding, late: Array) -> Array:
    return np.asarray(np.interp(hiding.time - late, hiding.time, inner(u)))


def _fast(inner: Response, u: Array, hiding: Hiding) -> Array:
    return _shown(inner, u, hiding, _late(hiding) * hiding.time / hiding.duration)


def _slow(inner: Response, u: Array, hiding: Hiding) -> Array:
    return _shown(inner, u, hiding, -_late(hiding) * hiding.time / hiding.duration)


def _warming(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A clock that warms up: its rate changes steadily."""
    return _shown(inner, u, hiding, _late(hiding) * (hiding.time / hiding.duration) ** 2)


def _lost(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A logger that loses samples, four times in the longest record."""
    return _shown(inner, u, hiding, 0.25 * _late(hiding) * np.floor(4.0 * hiding.time / hiding.duration))


@dataclass(frozen=True)
class ClockError(Effect):
    """The output's clock runs slow against the input's by a constant rate, from the first sample of every record [1].

    y(t) = x(t + rate (t - t_0)), x the response to the input as it was recorded, constant after its last sample. Linear
    between samples. At the time that a slow clock shows, more has passed. Below 0 it runs fast, and the output comes
    later and later, as behind a transport delay that grows.

    Every model and effect that does not know the absolute time nearly commutes with it: their time constants are off by
    the rate.

    [1] JCGM 200:2012, International vocabulary of metrology, 4.21 instrumental drift, of a time base.
    """

    acts = "output"
    family = "change with time, path or temperature"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "transport-delay": "over a short record a delay that grows is its mean",
        "late-input": "over a short record an advance that grows is its mean",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_fast, _slow)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_warming, _lost)
    parameters = (Parameter("rate", -0.01, 0.01, "1", null=0.0, meaning="by which the output's clock is slow"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.clock import clock

        output = inner(signal)
        return clock(signal.time, output, p.rate) if signal.timed else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to a quarter of the slowest record's period at the end of the longest record, and a tenth."""
        period = 1.0 / min(dominant_frequency(record) for record in records)
        most = min(LONGEST * period / longest(records), 0.1)
        return (self.parameters[0].within(-most, most),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)

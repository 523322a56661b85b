"""Transport delay: the response arrives later, unchanged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import longest_lag, middling_lag, tustin
from hysteresis_plugins.effects._ranges import FINEST, dominant_frequency, finest_step, unresolved


def _shifted(inner: Response, u: Array, hiding: Hiding) -> Array:
    """By whole samples."""
    y, late = inner(u), max(1, round(longest_lag(hiding) / hiding.step))
    return np.concatenate([np.full(late, y[0]), y[:-late]])


def _between(inner: Response, u: Array, hiding: Hiding) -> Array:
    return np.interp(hiding.time - middling_lag(hiding), hiding.time, inner(u))


def _all_pass(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Pade's approximation of the first order, as of a digital filter's phase."""
    half = 0.5 * longest_lag(hiding)
    return tustin(inner(u), [-half, 1.0], [half, 1.0], hiding.step)


def _two_ways(inner: Response, u: Array, hiding: Hiding) -> Array:
    """The mean of two delays, as of two pipes of unlike length."""
    y, late = inner(u), longest_lag(hiding)
    mean: Array = np.mean([np.interp(hiding.time - part * late, hiding.time, y) for part in (0.8, 1.2)], axis=0)
    return mean


@dataclass(frozen=True)
class TransportDelay(Effect):
    """A pure delay between input and output, such as an instrument's or a pipe's.

    y(t) = x(t - delay), x the response, constant before the first sample [1]. Linear between samples.

    Every model and effect that does not know the absolute time commutes with a delay, so it acts on the
    output, where interpolation keeps the response's extrema; interpolating the input would cut the turning
    points that the memory of a hysteresis is made of.

    The box is logarithmic and ends above the null 0, at a delay of a fiftieth of a sampling step, which no
    longer differs from none. Its upper edge is half a period of the input: a longer delay of a periodic
    signal looks like a shorter one.

    [1] K. Ogata, Modern Control Engineering, 5th ed., Prentice Hall (2010), transport lag.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    relaxes = True
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_shifted, _between)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_all_pass, _two_ways)
    parameters = (Parameter("delay", 1e-4, 1.0, "{time}", "log", null=0.0, meaning="of the output"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.delay import delay

        output = inner(signal)
        return delay(signal.time, output, p.delay) if signal.timed else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From a fiftieth of a sampling step to half the period of the slowest record's input."""
        period = 1.0 / min(dominant_frequency(record) for record in records)
        return (self.parameters[0].within(FINEST * finest_step(records), 0.5 * period),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)

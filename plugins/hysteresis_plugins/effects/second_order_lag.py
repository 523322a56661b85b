"""Second-order lag: what is measured follows the response through two lags in series, or an instrument's filter."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import unresolved_curve
from hysteresis_plugins.effects._second_order import (
    PARAMETERS,
    box,
    butterworth,
    late,
    moving_average,
    third_butterworth,
    three_apart,
    two_equal,
)


def _two_in_series(inner: Response, u: Array, hiding: Hiding) -> Array:
    return two_equal(inner(u), hiding)


def _instrument(inner: Response, u: Array, hiding: Hiding) -> Array:
    return butterworth(inner(u), hiding)


def _third_order(inner: Response, u: Array, hiding: Hiding) -> Array:
    return third_butterworth(inner(u), hiding)


def _three_in_series(inner: Response, u: Array, hiding: Hiding) -> Array:
    return three_apart(inner(u), hiding)


def _moving_average(inner: Response, u: Array, hiding: Hiding) -> Array:
    return moving_average(inner(u), hiding)


@dataclass(frozen=True)
class SecondOrderLag(Effect):
    """A second-order lag after the hysteresis that does not resonate: two lags in series, such as a sensor on a wall,
    or the low-pass filter of an instrument.

    y'' + 2 damping omega y' + omega² y = omega² x, omega = 2 damping / time_constant, x the response: `resonance` from
    the damping on at which its gain has no peak, 1 / sqrt(2). At 1 both lags are equal; above, they have the time
    constants (damping ± sqrt(damping² - 1)) / omega, whose sum is `time_constant` [1]. Exact for a response that is
    linear between its samples, from static equilibrium with the first one.

    [1] K. Ogata, Modern Control Engineering, 5th ed., Prentice Hall (2010), second-order systems.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "output-lag": "where one of two lags is short against the fastest movement they are one lag",
        "input-lag": (
            "where one of two lags is short against the fastest movement they are one lag, on the other side of the "
            "hysteresis"
        ),
        "creep": "two lags far apart are a share that arrives late",
        "resonance": "about where its gain loses its peak a resonance is a second-order lag",
        "transport-delay": "far below its corner a filter only delays",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_two_in_series, _instrument)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_third_order, _three_in_series, _moving_average)
    parameters = PARAMETERS

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        return late(signal.time, output, p) if signal.timed else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        return box(records)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

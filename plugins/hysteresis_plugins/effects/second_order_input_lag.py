"""Second-order input lag: what drives the hysteresis follows the measured input through two lags in series."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

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
    third_butterworth,
    three_apart,
    two_equal,
)


def _two_in_series(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(two_equal(u, hiding))


def _amplifier(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(butterworth(u, hiding))


def _third_order(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(third_butterworth(u, hiding))


def _three_in_series(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(three_apart(u, hiding))


@dataclass(frozen=True)
class SecondOrderInputLag(Effect):
    """A second-order lag before the hysteresis that does not resonate: two lags in series, such as a thermal one behind
    an amplifier's, or the amplifier's own of second order.

    As `second-order-lag`, of the input: v'' + 2 damping omega v' + omega² v = omega² u, omega = 2 damping /
    time_constant, and the model sees v [1]. Exact for an input that is linear between its samples.

    [1] K. Ogata, Modern Control Engineering, 5th ed., Prentice Hall (2010), second-order systems.
    """

    acts = "input"
    family = "dynamics before the law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "input-lag": "where one of two lags is short against the fastest movement they are one lag",
        "output-lag": (
            "where one of two lags is short against the fastest movement they are one lag, on the other side of the "
            "hysteresis"
        ),
        "second-order-lag": (
            "a small lag before the hysteresis and one after it differ only at second order in frequency times lag, "
            "where the loop is not a straight line"
        ),
        "resonance": "a small lag before the hysteresis and one after it differ little, and so do weak peaks of a gain",
        "transport-delay": "far below its corner a filter only delays",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_two_in_series, _amplifier)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_third_order, _three_in_series)
    parameters = PARAMETERS

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed or not np.any(p.time_constant):  # the model sees the very input, still shared
            return inner(signal)
        return inner(signal.with_input(late(signal.time, signal.input, p)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        return box(records)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

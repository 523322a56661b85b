"""Settling: the output's zero still relaxes from what happened before the record began."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import longest, output_span, without_time

SHORTEST = 0.02
"""Of the longest record, the shortest time constant: less is a start transient, which is left out (`--skip`)."""


@dataclass(frozen=True)
class Settling(Effect):
    """The zero of the output settles after the set-up was switched on: warm-up, or creep of what went before.

    y = x + size (1 - exp(-(t - t_0) / time_constant)), x the response, t_0 the first sample: what a first-order system
    still owes to a step before the record. All records settle alike, as where each begins with the same switch-on.

    [1] JCGM 200:2012, International vocabulary of metrology, 4.21 instrumental drift.
    """

    parameters = (
        Parameter("size", -1.0, 1.0, "{output}", null=0.0, meaning="by which the zero moves in the end"),
        Parameter("time_constant", 1.0, 100.0, "{time}", "log", meaning="of the approach"),
    )

    def apply(self, inner: Callable[[Signal], NDArray], signal: Signal, p: Any) -> NDArray:
        output = inner(signal)
        if not signal.timed:
            return output
        return output - p.size * np.expm1(-(signal.time - signal.time[0])[:, None] / p.time_constant)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Half the output's range either way; from a fiftieth of the longest record to its whole duration."""
        size, time_constant = self.parameters
        span, duration = output_span(records) or 1.0, longest(records)
        return size.within(-0.5 * span, 0.5 * span), time_constant.within(SHORTEST * duration, duration)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records)

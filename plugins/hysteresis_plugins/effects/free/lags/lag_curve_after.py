"""Lag curve after: what is measured is behind the response by a curve of its own rate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import input_span, output_span, unresolved_curve
from hysteresis_plugins.effects.free.lags._rate import LIMITS, behind, box, curve, parameters


@dataclass(frozen=True)
class LagCurveAfter(FreeForm):
    """What is measured is behind the response by a curve of its own rate: slower down than up, or slower the faster it
    goes.

    x - y = g(dy/dt), x the response, y = x at the first sample; g rises through the origin in two straight pieces a
    side [1]. A valve, a clamp, a sensor that limits its slew rate. Exact for a response that is linear between its
    samples.

    [1] J.-J. E. Slotine, W. Li, Applied Nonlinear Control, Prentice Hall (1991), ch. 1: a first-order system whose
    damping is a curve of the velocity.
    """

    acts = "output"
    family = "dynamics after the law"
    limits = LIMITS
    parameters = parameters("{output}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        return behind(signal.time, output, p) if signal.timed else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """A bend within the rates of the output, if it moved as the input does; time constants up to a quarter of the
        longest record."""
        return box(self.parameters, records, output_span(records) / input_span(records))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

    def curve(self, p: Any) -> Curve:
        return curve(p, "the output", "{output}")

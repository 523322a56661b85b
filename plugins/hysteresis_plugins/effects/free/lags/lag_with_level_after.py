"""Lag with level after: what is measured follows the response with a time constant of its own at every level."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import offset, unresolved_curve
from hysteresis_plugins.effects.free._spline import extremes
from hysteresis_plugins.effects.free.lags._level import ACCURACY, LIMITS, RANGES, behind, box, curve, parameters, starts


@dataclass(frozen=True)
class LagWithLevelAfter(FreeForm):
    """What is measured follows the response, slower at some levels than at others.

    tau(y) dy/dt + y = x, x the response, y = x at the first sample; tau is linear between five levels over the measured
    range. A sensor or a load whose time constant depends on the operating point [1].

    [1] D. E. Seborg, T. F. Edgar, D. A. Mellichamp, F. J. Doyle, Process Dynamics and Control, 4th ed., Wiley (2016),
    ch. 16.
    """

    acts = "output"
    family = "dynamics after the law"
    ranges = RANGES
    limits = LIMITS
    accuracy = ACCURACY
    parameters = parameters("{output}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        return behind(signal.time, output, p) if signal.timed else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Levels over the measured range, without an offset that is to be seen; time constants up to a quarter of the
        longest record."""
        return box(self.parameters, records, *extremes([record.measured - offset(records) for record in records]))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        return starts(records)

    def curve(self, p: Any) -> Curve:
        return curve(p, "the output", "{output}")

"""Lag with level before: what acts follows the input with a time constant of its own at every level."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import unresolved_curve
from hysteresis_plugins.effects.free._spline import extremes
from hysteresis_plugins.effects.free.lags._level import ACCURACY, LIMITS, RANGES, behind, box, curve, parameters, starts


@dataclass(frozen=True)
class LagWithLevelBefore(FreeForm):
    """What acts follows the input, slower at some levels than at others.

    tau(v) dv/dt + v = u, v = u at the first sample, the model sees v; tau is linear between five levels over the range
    of the input. A heat capacity or a heat transfer that depends on the temperature, a first-order system whose
    time constant depends on the operating point [1].

    [1] D. E. Seborg, T. F. Edgar, D. A. Mellichamp, F. J. Doyle, Process Dynamics and Control, 4th ed., Wiley (2016),
    ch. 16.
    """

    acts = "input"
    family = "dynamics before the law"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "lag-with-level-after": (
            "what lags before a rate-independent hysteresis and what lags after it differ only where the loop is not a "
            "straight line"
        ),
    }
    ranges = RANGES
    limits = LIMITS
    accuracy = ACCURACY
    parameters = parameters("{input}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed or not np.any(p.time_constant):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(behind(signal.time, signal.input, p)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Levels over the range of the input, time constants up to a quarter of the longest record."""
        return box(self.parameters, records, *extremes([record.input for record in records]))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        return starts(records)

    def curve(self, p: Any) -> Curve:
        return curve(p, "what acts", "{input}")

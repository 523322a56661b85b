"""Lag curve before: what acts is behind the input by a curve of its own rate."""

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
from hysteresis_plugins.effects.free.lags._rate import LIMITS, behind, box, constants, curve, parameters


@dataclass(frozen=True)
class LagCurveBefore(FreeForm):
    """What acts is behind the input by a curve of its own rate: slower down than up, or slower the faster it goes.

    u - v = g(dv/dt), v = u at the first sample, the model sees v; g rises through the origin in two straight pieces a
    side [1]. Heating and cooling, filling and venting, an amplifier that limits its slew rate. Exact for an input that
    is linear between its samples.

    [1] J.-J. E. Slotine, W. Li, Applied Nonlinear Control, Prentice Hall (1991), ch. 1: a first-order system whose
    damping is a curve of the velocity.
    """

    acts = "input"
    family = "dynamics before the law"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "lag-curve-after": (
            "what lags before a rate-independent hysteresis and what lags after it differ only where the loop is not a "
            "straight line"
        ),
    }
    limits = LIMITS
    parameters = parameters("{input}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed or not np.any(constants(p)):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(behind(signal.time, signal.input, p)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """A bend within the rates of the input, time constants up to a quarter of the longest record, beyond it
        up to ten of them."""
        return box(self.parameters, records, 1.0)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

    def curve(self, p: Any) -> Curve:
        return curve(p, "what acts", "{input}")

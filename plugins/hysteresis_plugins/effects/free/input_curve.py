"""Input curve: what acts is any smooth curve of the input."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import motionless
from hysteresis_plugins.effects.free._spline import POINTS, add, bent, extremes, narrow

BEND = bent("bend")


@dataclass(frozen=True)
class InputCurve(FreeForm):
    """The model sees a smooth curve of the input in its place.

    v = u + d(u), the model sees v: a static nonlinearity before the hysteresis, as in Hammerstein models [1]; d is a
    natural cubic spline [2], linear in its ordinates, and straight beyond the range. It has no
    straight line in it, because a shift and a gain belong to the law.

    [1] F. Giri, E.-W. Bai (eds.), Block-oriented Nonlinear System Identification, Springer (2010).
    [2] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "input"
    family = "curve of the input"
    affine = True
    ranges = ("lowest", "highest")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("lowest", -2.0, -1.0, "{input}", meaning="input at the first knot"),
        Parameter("highest", 1.0, 2.0, "{input}", meaning="input at the last knot"),
        *BEND.parameters("{input}", "change of what acts"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not np.any(p[2:]):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        acting = np.repeat(signal.input, p.lowest.size // signal.input.shape[1], axis=1)
        add(acting, signal.input, BEND.curves(p.lowest, p.highest, p))
        return inner(signal.with_input(acting))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Bends of up to half the range."""
        low, high = extremes([record.input for record in records])
        lowest, highest, *bends = self.parameters
        span = (high - low) or 1.0
        return (
            narrow(lowest, low, span),
            narrow(highest, high, span),
            *(one.within(-0.5 * span, 0.5 * span) for one in bends),
        )

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

    def curve(self, p: Any) -> Curve:
        given = np.linspace(p.lowest, p.highest, POINTS)
        answer = given + BEND.drawn(given, p.lowest, p.highest, p)
        return Curve(given, answer, "input", "input that acts", "{input}", "{input}")

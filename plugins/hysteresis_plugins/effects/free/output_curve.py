"""Output curve: what is measured is any smooth curve of the response."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import offset, output_span
from hysteresis_plugins.effects.free._spline import POINTS, add, bent, extremes, narrow

BEND = bent("bend")
WIDER = 0.1
"""Share of the measured range by which that of the response may be wider, to either side."""


@dataclass(frozen=True)
class OutputCurve(FreeForm):
    """What is measured is a smooth curve of the response.

    y = x + d(x), x the response: a static nonlinearity after the hysteresis, as in Wiener models [1]; d is a natural
    cubic spline [2], linear in its ordinates, and straight beyond the range. It is 0 in the
    middle, and its two ends are alike, because a shift and a gain of the output belong to the law and to its offset.

    [1] F. Giri, E.-W. Bai (eds.), Block-oriented Nonlinear System Identification, Springer (2010).
    [2] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "output"
    family = "curve of the output"
    ranges = ("lowest", "highest")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("lowest", -2.0, -1.0, "{output}", meaning="response at the first knot"),
        Parameter("highest", 1.0, 2.0, "{output}", meaning="response at the last knot"),
        *BEND.parameters("{output}", "change of what is measured"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = own(inner(signal), signal)
        add(output, output, BEND.curves(p.lowest, p.highest, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Over the measured range, without an offset that is to be seen; bends of up to half of it."""
        low, high = extremes([record.measured - offset(records) for record in records])
        lowest, highest, *bends = self.parameters
        span = (high - low) or 1.0
        return (
            narrow(lowest, low - WIDER * span, span),
            narrow(highest, high + WIDER * span, span),
            *(one.within(-0.5 * span, 0.5 * span) for one in bends),
        )

    def inapplicable(self, records: Sequence[Record]) -> str:
        return "the output never moves" if output_span(records) == 0.0 else ""

    def curve(self, p: Any) -> Curve:
        given = np.linspace(p.lowest, p.highest, POINTS)
        answer = given + BEND.drawn(given, p.lowest, p.highest, p)
        return Curve(given, answer, "response", "output", "{output}", "{output}")

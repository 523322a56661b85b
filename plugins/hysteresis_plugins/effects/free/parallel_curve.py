"""Parallel curve: beside the hysteresis acts any smooth curve of the input."""

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
from hysteresis_plugins.effects._ranges import motionless, output_span
from hysteresis_plugins.effects.free._spline import POINTS, Spline, add, extremes, narrow

PIECES = 10
BEND = Spline("bend", tuple(k / PIECES for k in range(PIECES + 1)), PIECES // 2, tied=True)
ORDINATES = BEND.parameters("{output}", "what is added")
WIDER = 0.1
"""Share of the range of the input by which the knots go further, to either side: a natural spline is straight at its
ends, where a spring bends most. The fifth power is followed to 1e-4 of its range (RMS), a corner at half the range to
5e-3; with none of it to 3e-3 and 7e-3, with twice to 2e-4 and 6e-3."""


@dataclass(frozen=True)
class ParallelCurve(FreeForm):
    """Beside the hysteresis a smooth curve of the input is added to the output, such as a spring's that hardens.

    y = x + g(u), x the response: a restoring force without memory in parallel with one that has some [1]; g is a
    natural cubic spline [2], linear in its ordinates, and straight beyond the range. It is 0 at the middle and its two
    ends are alike, because a shift and a straight line belong to the law and to its offset.

    [1] F. Ikhouane, J. Rodellar, Systems with Hysteresis, Wiley (2007).
    [2] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "law"
    family = "curve beside the law"
    affine = True
    linear = tuple(one.name for one in ORDINATES)
    ranges = ("lowest", "highest")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("lowest", -2.0, -1.0, "{input}", meaning="input at the first knot"),
        Parameter("highest", 1.0, 2.0, "{input}", meaning="input at the last knot"),
        *ORDINATES,
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = own(inner(signal), signal)
        add(output, signal.input, BEND.curves(p.lowest, p.highest, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Over a little more than the range of the input; by up to the range of the output."""
        low, high = extremes([record.input for record in records])
        lowest, highest, *bends = self.parameters
        span, most = (high - low) or 1.0, output_span(records) or 1.0
        return (
            narrow(lowest, low - WIDER * span, span),
            narrow(highest, high + WIDER * span, span),
            *(one.within(-most, most) for one in bends),
        )

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

    def curve(self, p: Any) -> Curve:
        given = np.linspace(p.lowest, p.highest, POINTS)
        added = BEND.drawn(given, p.lowest, p.highest, p)
        return Curve(given, added, "input", "part added to the output", "{input}", "{output}")

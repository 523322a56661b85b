"""Input curve: what acts is any curve of the input that is smooth but for a corner at zero."""

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

STEEPER = 0.9
"""Largest corner: with 1 one side would not act at all."""

INSIDE = 0.1
"""Of the range, from either end, where a corner is looked for: closer to it is the outermost piece of the spline."""


@dataclass(frozen=True)
class InputCurve(FreeForm):
    """The model sees a curve of the input in its place, smooth but for a corner.

    v = u + d(u) + corner |u - origin|, the model sees v: a static nonlinearity before the hysteresis, as in Hammerstein
    models [1]; d is a natural cubic spline [2], linear in its ordinates, and straight beyond the range. It has no
    straight line in it, because a shift and a gain belong to the law. The corner lies where the input changes its sign:
    what pushes may not pull as strongly.

    [1] F. Giri, E.-W. Bai (eds.), Block-oriented Nonlinear System Identification, Springer (2010).
    [2] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "input"
    family = "curve of the input"
    affine = True
    ranges = ("lowest", "highest", "origin")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("lowest", -2.0, -1.0, "{input}", meaning="input at the first knot"),
        Parameter("highest", 1.0, 2.0, "{input}", meaning="input at the last knot"),
        Parameter("origin", -0.5, 0.5, "{input}", meaning="input at the corner"),
        Parameter(
            "corner", -STEEPER, STEEPER, null=0.0, meaning="half of what the slope is steeper by above the corner"
        ),
        *BEND.parameters("{input}", "change of what acts"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not np.any(p[3:]):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        acting = np.repeat(signal.input, p.lowest.size // signal.input.shape[1], axis=1)
        add(acting, signal.input, BEND.curves(p.lowest, p.highest, p))
        if np.any(p.corner):
            acting += p.corner * np.abs(signal.input - p.origin)
        return inner(signal.with_input(acting))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Bends of up to half the range; the corner at zero, or in the middle of a range in which zero does not lie
        well."""
        low, high = extremes([record.input for record in records])
        lowest, highest, origin, corner, *bends = self.parameters
        span = (high - low) or 1.0
        within = low + INSIDE * span < 0.0 < high - INSIDE * span
        return (
            narrow(lowest, low, span),
            narrow(highest, high, span),
            narrow(origin, 0.0 if within else 0.5 * (low + high), span),
            corner,
            *(one.within(-0.5 * span, 0.5 * span) for one in bends),
        )

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

    def curve(self, p: Any) -> Curve:
        given = np.linspace(p.lowest, p.highest, POINTS)
        answer = given + BEND.drawn(given, p.lowest, p.highest, p) + p.corner * np.abs(given - p.origin)
        return Curve(given, answer, "input", "input that acts", "{input}", "{input}")

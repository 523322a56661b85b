"""Damping curve: beside the hysteresis acts a force that is any smooth curve of the input's rate."""

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
from hysteresis_plugins.effects._ranges import fastest, output_span
from hysteresis_plugins.effects._rate import rate, without_rates
from hysteresis_plugins.effects.free._spline import POINTS, Spline, add, narrow

SIDE = 5
"""Knots to either side of rest, the denser the slower: there the forces of fluids and of dry friction bend most."""

FASTER = 1.1
"""Times the fastest input, where the last knots lie: a natural spline is straight at its ends."""

KNOTS = tuple(0.5 + 0.5 * np.sign(k) * (k / SIDE) ** 2 for k in range(-SIDE, SIDE + 1))
FORCE = Spline("force", tuple(float(one) for one in KNOTS), SIDE)


@dataclass(frozen=True)
class DampingCurve(FreeForm):
    """Beside the hysteresis a smooth curve of the input's rate is added to the output, such as a fluid damper's force.

    y = x + f(du/dt), x the response: as of dampers whose force goes with a power of the speed [1]; f is a natural cubic
    spline [2], linear in its ordinates, 0 at rest, nowhere of the other sign than the rate at its knots, and straight
    beyond the range.

    [1] A. A. Seleemah, M. C. Constantinou, Investigation of Seismic Response of Buildings with Linear and Nonlinear
        Fluid Viscous Dampers, NCEER-97-0004, Buffalo (1997).
    [2] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "law"
    family = "damping beside the law"
    affine = True
    linear = tuple(one.name for one in FORCE.parameters("", ""))
    ranges = ("fastest",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("fastest", 0.5, 10.0, "{input}/{time}", meaning="rate at the last knot", positive=True),
        *FORCE.parameters("{output}", "what is added"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed or signal.time.size < 2:
            return inner(signal)
        output = own(inner(signal), signal)
        add(output, rate(signal.time, signal.input), FORCE.curves(-p.fastest, p.fastest, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to the range of the output, with the sign of the rate."""
        most = output_span(records) or 1.0
        last, *forces = self.parameters
        lower, upper = forces[:SIDE], forces[SIDE:]
        return (
            narrow(last, FASTER * (fastest(records) or 1.0)),
            *(one.within(-most, 0.0) for one in lower),
            *(one.within(0.0, most) for one in upper),
        )

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_rates(records)

    def curve(self, p: Any) -> Curve:
        given = np.linspace(-p.fastest, p.fastest, POINTS)
        added = FORCE.drawn(given, -p.fastest, p.fastest, p)
        return Curve(given, added, "rate of the input", "part added to the output", "{input}/{time}", "{output}")

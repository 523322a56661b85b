"""Zero with time: the zero of the output moves from the first sample on, in any smooth way."""

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
from hysteresis_plugins.effects._ranges import longest, output_span, without_time
from hysteresis_plugins.effects.free._spline import POINTS, add, early, narrow

ZERO = early("zero")
ORDINATES = ZERO.parameters("{output}", "change of the output's zero")


@dataclass(frozen=True)
class ZeroWithTime(FreeForm):
    """The zero of the output moves with the time since the first sample of every record, along any smooth curve.

    y = x + z(t - t_0), x the response; z is a natural cubic spline [1] with z(0) = 0, linear in its ordinates, and
    level beyond the longest record.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "added"
    family = "change with time, path or temperature"
    affine = True
    linear = tuple(one.name for one in ORDINATES)
    ranges = ("duration",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("duration", 0.1, 1e3, "{time}", meaning="time of the last knot", positive=True),
        *ORDINATES,
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed:
            return inner(signal)
        output = own(inner(signal), signal)
        since = signal.time - signal.time[0]
        add(output, since[:, None], ZERO.curves(np.zeros_like(p.duration), p.duration, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """By up to the range of the output."""
        span = output_span(records) or 1.0
        return narrow(self.parameters[0], longest(records)), *(one.within(-span, span) for one in self.parameters[1:])

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records)

    def curve(self, p: Any) -> Curve:
        time = np.linspace(0.0, p.duration, POINTS)
        zero = ZERO.drawn(time, 0.0, p.duration, p)
        return Curve(time, zero, "time", "zero of the output", "{time}", "{output}")

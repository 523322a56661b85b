"""Gain with time: the amplitude of the output changes with the time since the first sample, in any smooth way."""

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
from hysteresis_plugins.effects._ranges import longest, without_time
from hysteresis_plugins.effects.free._spline import POINTS, early, narrow, scale

GAIN = early("gain")


@dataclass(frozen=True)
class GainWithTime(FreeForm):
    """The amplitude of the output changes with the time since the first sample of every record, along any smooth curve.

    y = x (1 + g(t - t_0)), x the response, as of a device that warms up or ages; g is a natural cubic spline [1] with
    g(0) = 0, linear in its ordinates, and level beyond the longest record.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "output"
    family = "change with time, path or temperature"
    affine = True
    ranges = ("duration",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("duration", 0.1, 1e3, "{time}", meaning="time of the last knot", positive=True),
        *GAIN.parameters("1", "relative change of the response"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed:
            return inner(signal)
        output = own(inner(signal), signal)
        since = (signal.time - signal.time[0])[:, None]
        scale(output, since, GAIN.curves(np.zeros_like(p.duration), p.duration, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The gain from a twentieth to four times that of the beginning."""
        return narrow(self.parameters[0], longest(records)), *(one.within(-0.95, 3.0) for one in self.parameters[1:])

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records)

    def curve(self, p: Any) -> Curve:
        time = np.linspace(0.0, p.duration, POINTS)
        gain = 1.0 + GAIN.drawn(time, 0.0, p.duration, p)
        return Curve(time, gain, "time", "gain", "{time}")

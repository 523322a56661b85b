"""Gain with path: the amplitude of the output changes along the path travelled, in any smooth way."""

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
from hysteresis_plugins.effects.fatigue import Fatigue, travelled
from hysteresis_plugins.effects.free._spline import POINTS, early, narrow, scale

GAIN = early("gain")


@dataclass(frozen=True)
class GainWithPath(FreeForm):
    """The amplitude of the output changes with the path that the input has travelled, along any smooth curve.

    y = x (1 + g(s)), s = sum |u_i - u_(i-1)| since the first sample of the record, x the response; g is a natural
    cubic spline [1] with g(0) = 0, linear in its ordinates, and level beyond the longest path.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "output"
    family = "change with time, path or temperature"
    affine = True
    ranges = ("longest",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("longest", 0.1, 1e3, "{input}", meaning="path of the last knot", positive=True),
        *GAIN.parameters("1", "relative change of the response"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = own(inner(signal), signal)
        scale(output, travelled(signal.input), GAIN.curves(np.zeros_like(p.longest), p.longest, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The gain from a twentieth to four times that of the beginning."""
        path = max(float(travelled(record.signal.input)[-1, 0]) for record in records) or 1.0
        return narrow(self.parameters[0], path), *(one.within(-0.95, 3.0) for one in self.parameters[1:])

    def inapplicable(self, records: Sequence[Record]) -> str:
        return Fatigue().inapplicable(records)

    def curve(self, p: Any) -> Curve:
        path = np.linspace(0.0, p.longest, POINTS)
        gain = 1.0 + GAIN.drawn(path, 0.0, p.longest, p)
        return Curve(path, gain, "path travelled by the input", "gain", "{input}")

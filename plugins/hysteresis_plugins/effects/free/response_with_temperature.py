"""Response with temperature: gain and zero of the output change with a measured temperature, in any smooth way."""

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
from hysteresis_plugins.effects._ranges import output_span
from hysteresis_plugins.effects.free._spline import POINTS, Spline, add, extremes, narrow, scale
from hysteresis_plugins.effects.temperature_sensitivity import TemperatureSensitivity

KNOTS = tuple(k / 6.0 for k in range(7))
GAIN, ZERO = (Spline(prefix, KNOTS, 3, held=True) for prefix in ("gain", "zero"))
GAINS = GAIN.parameters("1", "relative change of the response")
ZEROS = ZERO.parameters("{output}", "change of the output's zero")


@dataclass(frozen=True)
class ResponseWithTemperature(FreeForm):
    """Gain and zero of the output change with the temperature, which a column of the data tells, along smooth curves.

    y = x (1 + g(T)) + z(T), x the response; g and z are natural cubic splines [1], 0 in the middle of the range,
    linear in their ordinates, and level beyond it.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "output"
    family = "change with time, path or temperature"
    wants = TemperatureSensitivity.wants
    affine = True
    linear = tuple(one.name for one in ZEROS)
    ranges = ("lowest", "highest")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("lowest", 0.0, 20.0, "degC", meaning="temperature of the first knot"),
        Parameter("highest", 25.0, 100.0, "degC", meaning="temperature of the last knot"),
        *GAINS,
        *ZEROS,
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if "temperature" not in signal.columns:
            raise ValueError("response-with-temperature needs a column temperature; these data have none")
        output = own(inner(signal), signal)
        temperature = signal.columns["temperature"][:, None]
        scale(output, temperature, GAIN.curves(p.lowest, p.highest, p))
        add(output, temperature, ZERO.curves(p.lowest, p.highest, p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The gain from a twentieth to four times that in the middle; the zero by up to the range of the output."""
        low, high = extremes([record.columns["temperature"] for record in records])
        lowest, highest, *others = self.parameters
        span = output_span(records) or 1.0
        return (
            narrow(lowest, low, high - low),
            narrow(highest, high, high - low),
            *(one.within(-0.95, 3.0) if one in GAINS else one.within(-span, span) for one in others),
        )

    def inapplicable(self, records: Sequence[Record]) -> str:
        return TemperatureSensitivity().inapplicable(records)

    def curve(self, p: Any) -> Curve:
        temperature = np.linspace(p.lowest, p.highest, POINTS)
        return Curve(temperature, 1.0 + GAIN.drawn(temperature, p.lowest, p.highest, p), "temperature", "gain", "degC")

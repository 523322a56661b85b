"""Disturbance wave: a hum of any waveform on the output, which may swell and fade."""

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
from hysteresis_plugins.effects._ranges import longest, output_span
from hysteresis_plugins.effects.free._spline import POINTS, Spline, narrow
from hysteresis_plugins.effects.periodic_disturbance import PeriodicDisturbance

KNOTS = tuple(k / 4.0 for k in range(5))
SWELLS = tuple(Spline(name, KNOTS, None, held=True) for name in ("cosine", "sine"))
OVERTONES = (2, 3)
SWELLING = tuple(one for swell in SWELLS for one in swell.parameters("{output}", "amplitude"))
CONSTANT = tuple(
    Parameter(f"{name}_of_{order}", -1.0, 1.0, "{output}", null=0.0, meaning=f"amplitude of harmonic {order}")
    for order in OVERTONES
    for name in ("cosine", "sine")
)


@dataclass(frozen=True)
class DisturbanceWave(FreeForm):
    """A hum of any waveform is added to the output; its amplitude may change along a smooth curve.

    y = x + a(t) cos(2 pi f t) + b(t) sin(2 pi f t) + overtones 2 and 3 of constant amplitude, x the response, t the
    record's own time, as in `periodic-disturbance`; a and b are natural cubic splines [1] in the time since the first
    sample.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "added"
    family = "added disturbance"
    affine = True
    linear = tuple(one.name for one in (*SWELLING, *CONSTANT))
    ranges = ("duration",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("duration", 0.1, 1e3, "{time}", meaning="time of the last knot", positive=True),
        PeriodicDisturbance.parameters[2],
        *SWELLING,
        *CONSTANT,
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.wave import add_wave

        if not signal.timed:
            return inner(signal)
        output = own(inner(signal), signal)
        cosine, sine = (swell.curves(np.zeros_like(p.duration), p.duration, p) for swell in SWELLS)
        overtones = np.stack([getattr(p, one.name) for one in CONSTANT])
        add_wave(output, signal.time, p.frequency, cosine, sine, overtones)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Amplitudes up to half the range of the output; frequencies as of `periodic-disturbance`."""
        last, _, *amplitudes = self.parameters
        half = 0.5 * (output_span(records) or 1.0)
        frequency = PeriodicDisturbance().box(records)[2]
        return narrow(last, longest(records)), frequency, *(one.within(-half, half) for one in amplitudes)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return PeriodicDisturbance().inapplicable(records)

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        """The highest lines of the residuals' spectrum, of constant amplitude."""
        silent = dict.fromkeys(self.linear, 0.0)
        return [
            {
                **silent,
                "frequency": line["frequency"],
                **{one.name: line[one.name.rstrip("01234")] for one in SWELLING},
            }
            for line in PeriodicDisturbance().starts(records, residuals)
        ]

    def curve(self, p: Any) -> Curve:
        time = np.linspace(0.0, p.duration, POINTS)
        amplitude = np.hypot(*(swell.drawn(time, 0.0, p.duration, p) for swell in SWELLS))
        return Curve(time, amplitude, "time", "amplitude of the hum", "{time}", "{output}")

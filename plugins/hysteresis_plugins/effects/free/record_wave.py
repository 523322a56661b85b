"""Record wave: a hum that every record meets at another phase, as nothing starts a record in time with it."""

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
from hysteresis_plugins.effects.periodic_disturbance import PeriodicDisturbance, amplitudes_at

SWELL = Spline("amplitude", tuple(k / 4.0 for k in range(5)), None, held=True)
AMPLITUDES = SWELL.parameters("{output}", "amplitude of the hum")


@dataclass(frozen=True)
class RecordWave(FreeForm):
    """A hum of one frequency whose phase is every record's own; its amplitude may change along a smooth curve.

    y = x + a(t - t_0) cos(2 pi f t + q), x the response; a is a natural cubic spline [1], q is estimated on every
    record that has an output, from measured minus simulated over its scored samples. A record without an output is
    given no hum, as its phase is not known. Records of one clock share a phase: `periodic-disturbance`.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "added"
    family = "added disturbance"
    estimates = 1
    ranges = ("duration",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("duration", 0.1, 1e3, "{time}", meaning="time of the last knot", positive=True),
        PeriodicDisturbance.parameters[2],
        *AMPLITUDES,
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        return inner(signal)

    def adjust(self, simulated: Array, record: Record, p: Any = None) -> Array:
        from hysteresis_bench.kernels.effects.own_phase import add_at_own_phase

        if record.output is None or not record.timed or p is None:
            return simulated
        output = own(simulated, record.signal)
        curves = SWELL.curves(np.zeros_like(p.duration), p.duration, p)
        add_at_own_phase(output, record.time, record.measured, p.frequency, curves)
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
        """The highest lines of the residuals' spectrum, of the mean amplitude over the records."""
        found = []
        for line in PeriodicDisturbance().starts(records, residuals):
            each = [
                amplitudes_at([one], [left], line["frequency"]) for one, left in zip(records, residuals, strict=True)
            ]
            size = float(np.mean([np.hypot(one["cosine"], one["sine"]) for one in each]))
            found.append({"frequency": line["frequency"], **{one.name: size for one in AMPLITUDES}})
        return found

    def curve(self, p: Any) -> Curve:
        time = np.linspace(0.0, p.duration, POINTS)
        amplitude = np.abs(SWELL.drawn(time, 0.0, p.duration, p))
        return Curve(time, amplitude, "time", "amplitude of the hum", "{time}", "{output}")

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
OVERTONES = (2, 3)
CONSTANT = tuple(
    Parameter(f"amplitude_of_{order}", -1.0, 1.0, "{output}", null=0.0, meaning=f"amplitude of harmonic {order}")
    for order in OVERTONES
)


@dataclass(frozen=True)
class RecordWave(FreeForm):
    """A hum of one frequency whose phase is every record's own; its amplitude may change along a smooth curve.

    y = x + a(t - t_0) cos(2 pi f t + q) + overtones 2 and 3 of constant amplitude, each at a phase of its own, x the
    response; a is a natural cubic spline [1]. The phases are estimated on every record that has an output, from
    measured minus simulated over its scored samples. A record without an output is given no hum, as its phase is not
    known. Records of one clock share a phase: `periodic-disturbance`.

    [1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
    """

    acts = "added"
    family = "added disturbance"
    estimates = 1 + len(OVERTONES)
    ranges = ("duration",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("duration", 0.1, 1e3, "{time}", meaning="time of the last knot", positive=True),
        PeriodicDisturbance.parameters[2],
        *AMPLITUDES,
        *CONSTANT,
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        return inner(signal)

    def adjust(self, simulated: Array, record: Record, p: Any = None) -> Array:
        from hysteresis_bench.kernels.effects.natural_spline import natural_splines
        from hysteresis_bench.kernels.effects.own_phase import add_at_own_phase

        if record.output is None or not record.timed or p is None:
            return simulated
        output = own(simulated, record.signal)
        begin = np.zeros_like(p.duration)
        curves = SWELL.curves(begin, p.duration, p)
        add_at_own_phase(output, record.time, record.measured, p.frequency, curves)
        for order, one in zip(OVERTONES, CONSTANT, strict=True):
            size = getattr(p, one.name)
            if np.any(size):
                level = natural_splines(begin, p.duration, knots=(0.0, 1.0), ordinates=np.tile(size, (2, 1)), held=True)
                add_at_own_phase(output, record.time, record.measured, order * p.frequency, level)
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
            sizes = [_size(records, residuals, order * line["frequency"]) for order in (1, *OVERTONES)]
            swell = {one.name: sizes[0] for one in AMPLITUDES}
            overtones = {one.name: size for one, size in zip(CONSTANT, sizes[1:], strict=True)}
            found.append({"frequency": line["frequency"], **swell, **overtones})
        return found

    def curve(self, p: Any) -> Curve:
        time = np.linspace(0.0, p.duration, POINTS)
        amplitude = np.abs(SWELL.drawn(time, 0.0, p.duration, p))
        return Curve(time, amplitude, "time", "amplitude of the hum", "{time}", "{output}")


def _size(records: Sequence[Record], residuals: Sequence[Array], frequency: float) -> float:
    """Mean amplitude at a frequency, each record at its own phase."""
    each = [amplitudes_at([one], [left], frequency) for one, left in zip(records, residuals, strict=True)]
    return float(np.mean([np.hypot(one["cosine"], one["sine"]) for one in each]))

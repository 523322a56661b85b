"""Cogging wave: beside the hysteresis acts a force of any waveform that repeats itself along the input."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import output_span
from hysteresis_plugins.effects._ripple import AMPLITUDES
from hysteresis_plugins.effects.cogging import Cogging
from hysteresis_plugins.effects.free._spline import POINTS

ORDERS = tuple(range(1, 7))
WAVES = tuple(f"{name}{n}" for n in ORDERS for name in ("sine", "cosine"))


@dataclass(frozen=True)
class CoggingWave(FreeForm):
    """Beside the hysteresis acts a force of any waveform that repeats itself along the input, such as of sharp teeth.

    y = x + sum over n of sine_n sin(n w) + cosine_n cos(n w), w = 2 pi u / period, x the response: the first six
    harmonics, of which `cogging` has two.
    """

    acts = "law"
    family = "cyclic error"
    affine = True
    linear = WAVES
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Cogging.parameters[-1],
        *(Parameter(one, -1.0, 1.0, "{output}", null=0.0, meaning=f"amplitude of harmonic {one[-1]}") for one in WAVES),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.ripple import add_ripple

        output = own(inner(signal), signal)
        add_ripple(output, signal.input, p.period, np.stack([getattr(p, one) for one in WAVES]))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Periods as of `cogging`; amplitudes up to a fifth of the output's range."""
        most = 0.2 * (output_span(records) or 1.0)
        return Cogging().box(records)[-1], *(one.within(-most, most) for one in self.parameters[1:])

    def inapplicable(self, records: Sequence[Record]) -> str:
        return Cogging().inapplicable(records)

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]] | None:
        """The clearest periods along the input, of the clearest one also twice as long."""
        lines = Cogging().starts(records, residuals)
        if lines is None:
            return None
        return [*(_begun(one, 1) for one in lines), *(_begun(one, 2) for one in lines[:1])]

    def curve(self, p: Any) -> Curve:
        """Over two periods, finely enough for the last harmonic."""
        given = np.linspace(0.0, 2.0 * p.period, 4 * POINTS)
        turn = 2.0 * np.pi * given / p.period
        parts = [
            getattr(p, f"sine{n}") * np.sin(n * turn) + getattr(p, f"cosine{n}") * np.cos(n * turn) for n in ORDERS
        ]
        return Curve(given, np.sum(parts, axis=0), "input", "part added to the output", "{input}", "{output}")


def _begun(line: Mapping[str, float], order: int) -> dict[str, float]:
    """With the first harmonic of a line of `cogging` as the harmonic of this order."""
    amplitudes = {f"{name}{order}": line[name] for name in AMPLITUDES}
    return {**dict.fromkeys(WAVES, 0.0), "period": order * line["period"], **amplitudes}

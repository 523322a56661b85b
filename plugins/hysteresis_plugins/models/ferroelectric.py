"""Ferroelectric polarization: populations of domains that switch, and a linear permittivity.

[1] S. L. Miller, R. D. Nasby, J. R. Schwank, M. S. Rodgers, P. V. Dressendorfer, J. Appl. Phys. 68 (1990) 6463:
    branches of hyperbolic tangents.
[2] A. T. Bartic, D. J. Wouters, H. E. Maes, J. T. Rickes, R. M. Waser, J. Appl. Phys. 89 (2001) 3420: minor loops.

Legend: u field or voltage, y polarization, P_r the play of half-width r.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Example, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import STEEPEST, falling, input_span, offset, output_span, sense, sided, steepness
from hysteresis_plugins.models._plays import at_least, named
from hysteresis_plugins.models._threshold_rate import OFFERS, rated

TALLEST = 5.0
"""Largest saturation of a population in the box, in ranges of the output."""


def _parameters(populations: int) -> tuple[Parameter, ...]:
    own = (
        parameter
        for i in range(1, populations + 1)
        for parameter in (
            Parameter(f"P_{i}", 0.0, 5.0, "{output}", meaning=f"saturation of population {i}"),
            Parameter(f"r_{i}", 0.0, 0.5, "{input}", meaning=f"coercive field of population {i}"),
            Parameter(f"b_{i}", -0.5, 0.5, "{input}", meaning=f"internal field of population {i}"),
            Parameter(f"w_{i}", 0.02, 2.0, "{input}", "log", meaning=f"width of population {i}", positive=True),
        )
    )
    slope = Parameter("permittivity", 0.0, 5.0, "{output}/{input}", meaning="slope of the part without hysteresis")
    return (slope, *own)


@dataclass(frozen=True)
class Ferroelectric(Model):
    """Ferroelectric: populations of domains that switch at coercive fields of their own, and a permittivity.

    y = permittivity u + sum over populations i of P_i tanh((P_ri[u] - b_i) / w_i), r_i the coercive field: on the
    branches of a saturated loop the tanh((u ± r) / w) of [1], after a reversal it goes on from where it was, as in [2].
    Rate-independent; linear in permittivity and P_i. Internal fields b_i make the loop asymmetric.

    populations : how many, 1 to 12

    Ours: the hysteresis of minor loops is that of the play, which starts in the middle of its dead band. The constant
    is the effect bias, or record-offset.
    """

    parameters = _parameters(2)
    linear = ("permittivity", "P_1", "P_2")
    properties = ("rate-independent", "return-point", "congruent")
    offers = OFFERS
    example = Example(
        4.0,
        {
            "permittivity": 0.1,
            "P_1": 1.0,
            "r_1": 0.8,
            "b_1": 0.0,
            "w_1": 1.2,
            "P_2": 0.5,
            "r_2": 1.8,
            "b_2": 0.2,
            "w_2": 0.8,
        },
        stream=13,
        without=("threshold-rate",),
    )

    populations: int = 2

    def __post_init__(self) -> None:
        at_least("populations", self.populations, 1, 12)
        parameters = _parameters(self.populations)
        object.__setattr__(self, "parameters", parameters)
        object.__setattr__(self, "linear", ("permittivity", *named("P_", self.populations)))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play_tanh import play_tanh

        heights, radii, centres, widths = (
            np.stack([getattr(p, one) for one in named(f"{name}_", self.populations)]) for name in ("P", "r", "b", "w")
        )
        polarization = play_tanh(signal.input, heights, rated(radii, signal, p), centres, widths)
        polarization += p.permittivity * signal.input
        return polarization

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Coercive fields up to half the span of the input; widths from a hundredth of the span to twice of it;
        internal fields in the input's range; saturations up to five times the
        range of the output, on the side of the loops' sense, on both where the data do not say."""
        span, tallest = input_span(records), TALLEST * output_span(records)
        side = sense(records)
        low = min(float(np.min(record.input)) for record in records)
        high = max(float(np.max(record.input)) for record in records)
        middle = 0.5 * (low + high)
        most = STEEPEST * steepness(records)
        edges = {
            "r": (0.0, 0.5 * span),
            "b": (middle - 0.5 * span, middle + 0.5 * span),
            "w": (0.01 * span, 2.0 * span),
        }
        permittivity, *others = self.parameters
        return (
            permittivity.within(-most, most),
            *(sided(q, tallest, side) if q.name in self.linear else q.within(*edges[q.name[0]]) for q in others),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return falling(records, "a ferroelectric's rises") or offset(records)

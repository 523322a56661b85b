"""Kuhnen's modified Prandtl-Ishlinskii operator: plays, and a curve of one-sided dead zones behind them.

[1] K. Kuhnen, European Journal of Control 9 (2003) 407, equations (16) to (20).

Legend: u input, y output, P_r the play of half-width r, w_k relative weights, S_d the one-sided dead zone beyond d.
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
from hysteresis_plugins.models._data import STEEPEST, input_span, offset, sense, sided, steepness
from hysteresis_plugins.models._plays import OWN_SHAPES, RADIUS, SLOPE, at_least, named, radius_box, thresholds
from hysteresis_plugins.models._threshold_rate import OFFERS, rated

HEAVIEST = 10.0
"""Largest weight of a play in the box; the direct part has 1."""


def _parameters(plays: int, zones: int) -> tuple[Parameter, ...]:
    weights = (
        Parameter(name, 0.0, 2.0, meaning=f"weight of the play of half-width {k}/{plays + 1} radius, the input's is 1")
        for k, name in enumerate(named("w", plays), start=1)
    )
    bends = (
        Parameter(name, -5.0, 5.0, "{output}/{input}", meaning=f"change of the slope {where} the centre, dead zone {k}")
        for prefix, where in (("above", "above"), ("below", "below"))
        for k, name in enumerate(named(prefix, zones), start=1)
    )
    return (
        RADIUS,
        *weights,
        Parameter("centre", -0.25, 0.25, "{input}", meaning="of the curve"),
        Parameter("reach", 0.2, 1.0, "{input}", meaning="what the edges of the dead zones divide", positive=True),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the curve at its centre"),
        *bends,
    )


@dataclass(frozen=True)
class PrandtlIshlinskiiModified(Model):
    """Prandtl-Ishlinskii with one-sided dead zones in series: Kuhnen's modified operator, for loops without symmetry.

    z = (u + sum of w_k P_rk[u]) / (1 + sum of |w_k|), r_k = radius k / (plays + 1), and
    y = slope z + sum of bend_l S_dl[z - centre], d_l = ± reach l / (zones + 1) [1]; the bends are called above1, ...,
    and below1, .... Rate-independent. With w_k >= 0 the loop runs anticlockwise, with w_k <= 0 clockwise.

    plays : how many, 1 to 60;  zones : dead zones on each side of the centre, 1 to 20

    Ours: the weights are relative to that of the input itself, and z stays in the input's range; the curve has a
    centre, so that inputs of one sign have both sides. The constant is the effect bias, or record-offset.
    """

    parameters = _parameters(8, 3)
    linear = tuple(parameter.name for parameter in parameters[11:])
    own_shapes = OWN_SHAPES
    properties = ("rate-independent", "return-point")
    offers = OFFERS
    example = Example(
        4.0,
        {
            "radius": 4.0,
            **{name: 0.25 for name in named("w", 8)},
            "centre": 0.0,
            "reach": 4.0,
            "slope": 1.2,
            **{name: -0.2 for name in named("above", 3)},
            **{name: 0.1 for name in named("below", 3)},
        },
        stream=6,
        without=("threshold-rate",),
    )

    plays: int = 8
    zones: int = 3

    def __post_init__(self) -> None:
        at_least("plays", self.plays, 1, 60)
        at_least("zones", self.zones, 1, 20)
        parameters = _parameters(self.plays, self.zones)
        object.__setattr__(self, "parameters", parameters)
        object.__setattr__(self, "linear", tuple(parameter.name for parameter in parameters[self.plays + 3 :]))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.dead_zones import dead_zones
        from hysteresis_bench.kernels.play_bank import play_bank

        weights = np.stack([np.ones_like(p.radius), *(getattr(p, name) for name in named("w", self.plays))])
        weights /= np.sum(np.abs(weights), axis=0)
        z = play_bank(signal.input, rated(thresholds(p.radius, self.plays), signal, p), weights[:, None])
        edges = thresholds(p.reach, self.zones)[1:]
        bends = np.stack([getattr(p, name) for side in ("above", "below") for name in named(side, self.zones)])
        return dead_zones(z, p.centre, p.slope, np.concatenate([edges, -edges]), bends)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Radius at most half the span of the input, reach a fifth to three fifths of it; the centre in the middle half
        of its range; slopes up to 50 times the ratio of the spans; the weights on the side of the loops' sense, on both
        where the data do not say."""
        radius, *weights = self.parameters[: self.plays + 1]
        centre, reach, *slopes = self.parameters[self.plays + 1 :]
        low = min(float(np.min(record.input)) for record in records)
        high = max(float(np.max(record.input)) for record in records)
        half, most, side = 0.5 * input_span(records), STEEPEST * steepness(records), sense(records)
        middle = 0.5 * (low + high)
        return (
            radius_box(radius, records),
            *(sided(weight, HEAVIEST, side) for weight in weights),
            centre.within(middle - 0.5 * half, middle + 0.5 * half),
            reach.within(0.4 * half, 1.2 * half),
            *(slope.within(-most, most) for slope in slopes),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

    def density(self, p: Any, places: Array) -> tuple[Array, Array, str]:
        weights = np.stack([getattr(p, name) for name in named("w", self.plays)])
        relative = weights / (1.0 + np.sum(np.abs(weights), axis=0))
        told = f"{SLOPE}, at the centre of the curve behind the plays"
        return thresholds(p.radius, self.plays)[1:, 0], p.slope * relative, told

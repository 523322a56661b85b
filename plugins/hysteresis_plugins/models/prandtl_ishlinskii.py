"""Prandtl-Ishlinskii: a weighted sum of play operators.

[1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
[2] K. Kuhnen, European Journal of Control 9 (2003) 407.

Legend: u input, y output, P_r the play of half-width r, w_k weights.
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
from hysteresis_plugins.models._data import STEEPEST, offset, sense, sided, steepness
from hysteresis_plugins.models._plays import OWN_SHAPES, RADIUS, SLOPE, at_least, named, radius_box, thresholds
from hysteresis_plugins.models._threshold_rate import OFFERS, rated


def _parameters(plays: int) -> tuple[Parameter, ...]:
    slope = Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part without hysteresis")
    weights = (
        Parameter(
            name, 0.0, 5.0, "{output}/{input}", meaning=f"weight of the play of half-width {k}/{plays + 1} radius"
        )
        for k, name in enumerate(named("w", plays), start=1)
    )
    return (RADIUS, slope, *weights)


@dataclass(frozen=True)
class PrandtlIshlinskii(Model):
    """Prandtl-Ishlinskii: a line and a weighted sum of play operators, linear in all its weights.

    y = slope u + sum of w_k P_rk[u], r_k = radius k / (plays + 1), k = 1 to plays [1, 2]. Rate-independent, and of
    Masing's rule: all branches are one curve, scaled by 2. With w_k >= 0 the loop runs anticlockwise, output over
    input, with w_k <= 0 clockwise; the box takes the side on which the records' loops run.

    plays : how many, 1 to 60

    The constant of the literature is the effect bias, or record-offset. Ours: the radius is a parameter that ends at
    half the range of the input, so that no threshold lies where the data never were; every play starts in the middle
    of its dead band.
    """

    parameters = _parameters(12)
    linear = tuple(parameter.name for parameter in parameters[1:])
    own_shapes = OWN_SHAPES
    properties = ("rate-independent", "odd", "masing", "return-point", "congruent")
    offers = OFFERS
    example = Example(
        4.0,
        {"radius": 4.0, "slope": 0.6, **{name: 0.3 / k for k, name in enumerate(named("w", 12), 1)}},
        stream=5,
        without=("input-bias",),
    )

    plays: int = 12

    def __post_init__(self) -> None:
        at_least("plays", self.plays, 1, 60)
        object.__setattr__(self, "parameters", _parameters(self.plays))
        object.__setattr__(self, "linear", tuple(parameter.name for parameter in self.parameters[1:]))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play_bank import play_bank

        weights = np.stack([p.slope, *(getattr(p, name) for name in named("w", self.plays))])
        return play_bank(signal.input, rated(thresholds(p.radius, self.plays), signal, p), weights[:, None])

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The radius at most half the span of the input; weights up to 50 times the ratio of the spans, on the side
        of the loops' sense, on both where the data do not say."""
        radius, slope, *weights = self.parameters
        most, side = STEEPEST * steepness(records), sense(records)
        return (
            radius_box(radius, records),
            slope.within(-most, most),
            *(sided(weight, most, side) for weight in weights),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

    def density(self, p: Any, places: Array) -> tuple[Array, Array, str]:
        weights = np.stack([getattr(p, name) for name in named("w", self.plays)])
        return thresholds(p.radius, self.plays)[1:, 0], weights, SLOPE

"""Maxwell-slip friction: springs that slip, side by side.

[1] W. D. Iwan, J. Applied Mechanics 33 (1966) 893.
[2] F. Al-Bender, V. Lampaert, J. Swevers, IEEE Trans. Automatic Control 50 (2005) 1883.

Legend: u displacement, F force, E_r the stop of half-width r: the strain of a spring that slips at r.
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
from hysteresis_plugins.models._data import STEEPEST, input_span, offset, output_span, sense, sided, steepness
from hysteresis_plugins.models._plays import OWN_SHAPES, RADIUS, at_least, named, radius_box
from hysteresis_plugins.models._threshold_rate import OFFERS, rated

NARROWEST = 0.02
"""Least radius, in half ranges of the input: friction sticks over a small part of the way."""
WIDEST_GAP = 0.2
"""Largest clearance to either side, in ranges of the input."""
STRONGEST = 2.0
"""Largest force of one element, in ranges of the output."""


def _parameters(elements: int) -> tuple[Parameter, ...]:
    springs = (
        Parameter(name, 0.0, 50.0, "{output}/{input}", meaning=f"stiffness of what slips at {k}²/{elements}² radius")
        for k, name in enumerate(named("k", elements), start=1)
    )
    return (
        RADIUS.within(0.01, 0.5),
        Parameter("gap", 0.0, 0.2, "{input}", meaning="half of the clearance that is crossed without force"),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part without hysteresis"),
        *springs,
    )


@dataclass(frozen=True)
class MaxwellSlip(Model):
    """Maxwell-slip: a spring, and springs that slip, side by side; linear in all stiffnesses.

    F = slope u + sum of k_i E_ri[u], r_i = radius (i / elements)², i = 1 to elements [1, 2]. Rate-independent, and
    without clearance (below) of Masing's rule. With k_i >= 0 it is passive and its loop runs clockwise, force over
    displacement; with k_i <= 0 anticlockwise. The box takes the side on which the records' loops run.

    elements : how many springs slip, 1 to 40; six made smooth loops were predicted at 1.4 to 2.3 times the noise with
        8, at 1.06 to 1.9 with 16

    Ours: every element has a clearance in series, the same for all, which leaves a plateau of no force after a
    reversal as in a device with backlash; gap = 0 is the literature's. All start unstrained. The constant is the
    effect bias, or record-offset.
    """

    parameters = _parameters(16)
    linear = tuple(parameter.name for parameter in parameters[2:])
    own_shapes = OWN_SHAPES
    properties = ("rate-independent", "odd", "return-point")
    offers = OFFERS
    example = Example(
        4.0,
        {"radius": 2.0, "gap": 0.0, "slope": 0.3, **{name: 0.5 / k for k, name in enumerate(named("k", 16), 1)}},
        stream=8,
        without=("input-bias",),
    )

    elements: int = 16

    def __post_init__(self) -> None:
        at_least("elements", self.elements, 1, 40)
        object.__setattr__(self, "parameters", _parameters(self.elements))
        object.__setattr__(self, "linear", tuple(parameter.name for parameter in self.parameters[2:]))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.stop_bank import stop_bank

        stiffnesses = np.stack([getattr(p, name) for name in named("k", self.elements)])
        return stop_bank(signal.input, p.slope, rated(self.limits(p.radius), signal, p), stiffnesses, p.gap)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The radius from a fiftieth of half the span of the input to all of it, the gap up to a fifth of the span;
        stiffnesses up to what makes twice the range of the output, on the side of the loops' sense, on both where the
        data do not say."""
        radius, gap, slope, *springs = self.parameters
        span, side = input_span(records), -sense(records)
        strongest = STRONGEST * output_span(records) / (self._shares * 0.5 * span * NARROWEST)
        most = STEEPEST * steepness(records)
        return (
            radius_box(radius, records, NARROWEST),
            gap.within(0.0, WIDEST_GAP * span),
            slope.within(-most, most),
            *(sided(one, float(edge), side) for one, edge in zip(springs, strongest, strict=True)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

    def density(self, p: Any, places: Array) -> tuple[Array, Array, str]:
        stiffnesses = np.stack([getattr(p, name) for name in named("k", self.elements)])
        return self.limits(p.radius)[:, 0], stiffnesses, "stiffness of each element, until it slips"

    def limits(self, radius: Array) -> Array:
        """Where the elements slip, (elements, swarm)."""
        return self._shares[:, None] * radius

    @property
    def _shares(self) -> Array:
        """Limits over the radius, (elements,): dense where friction begins to slip."""
        shares: Array = (np.arange(1, self.elements + 1) / self.elements) ** 2
        return shares

"""The Preisach operator in play form with curves of straight pieces: a density that is read off the data.

[1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), section 2.4.
[2] I. D. Mayergoyz, Mathematical Models of Hysteresis, Springer (1991), section 1.3: what first-order reversal curves
    tell of the density.

Legend: u input, y output, P_r the play of half-width r, w_kj weights.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import STEEPEST, falling, input_span, offset, output_span, sense, sided, steepness
from hysteresis_plugins.models._plays import RADIUS, at_least, radius_box
from hysteresis_plugins.models._threshold_rate import OFFERS, rated

TALLEST = 2.0
"""Largest rise of one piece, in ranges of the output."""
NARROWEST = 0.02
"""Least radius, in half ranges of the input."""
GRADING = 3.0
"""Of the nodes: the pieces at the ends are cosh of it times as long as those at the centre."""


def _parameters(plays: int, pieces: int) -> tuple[Parameter, ...]:
    weights = (
        Parameter(f"w{k}_{j}", 0.0, 2.0, "{output}", meaning=f"rise of the play of half-width {k}/{plays} radius, {j}")
        for k in range(plays + 1)
        for j in range(1, pieces + 1)
    )
    return (
        RADIUS,
        Parameter("centre", -0.25, 0.25, "{input}", meaning="of the nodes"),
        Parameter("reach", 0.1, 1.0, "{input}", "log", meaning="from the centre to the last node", positive=True),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part that does not saturate"),
        *weights,
    )


@dataclass(frozen=True)
class PreisachHats(Model):
    """Preisach in play form with monotone curves of straight pieces: reads a density off reversal curves.

    y = slope u + sum over k = 0 to plays of phi_k(P_rk[u]), r_k = radius k / plays; phi_k rises by w_kj from node j - 1
    to node j, and stays outside the nodes [1]; many curves with a reversal of their own determine the weights [2].
    Rate-independent, with wiping out and congruency; linear in slope and weights. With weights from 0 up the loop runs
    anticlockwise, and the curves never fall; the box takes the side of the records' loops, for the curve of the input
    itself either sign where they run clockwise or fall.

    plays : how many besides the input itself, 1 to 40;  pieces : of every curve, 2 to 60

    Ours: the nodes are dense about a centre, which is a parameter as is their reach. Give it reversal curves, each with
    the saturation that it comes from as its first samples: one loop cannot tell so many weights. Every play starts in
    the middle of its dead band. The constant is the effect bias, or record-offset.
    """

    parameters = _parameters(8, 12)
    linear = tuple(parameter.name for parameter in parameters[3:])
    properties = ("rate-independent", "return-point", "congruent")
    offers = OFFERS

    plays: int = 8
    pieces: int = 12

    def __post_init__(self) -> None:
        at_least("plays", self.plays, 1, 40)
        at_least("pieces", self.pieces, 2, 60)
        object.__setattr__(self, "parameters", _parameters(self.plays, self.pieces))
        object.__setattr__(self, "linear", tuple(parameter.name for parameter in self.parameters[3:]))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play_hats import play_hats

        weights = np.stack(p[4 : len(self.parameters)]).reshape(self.plays + 1, self.pieces, -1)
        radii = np.arange(self.plays + 1)[:, None] * (p.radius / self.plays)
        y = play_hats(signal.input, rated(radii, signal, p), p.centre + self._nodes[:, None] * p.reach, weights)
        y += p.slope * signal.input
        return y

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The radius from a fiftieth to all of half the span of the input, the reach from a tenth of that half to all
        of it, the centre in the middle half; weights up to twice the range of the output, on the side of the loops'
        sense, on both where the data do not say."""
        radius, centre, reach, slope, *weights = self.parameters
        low = min(float(np.min(record.input)) for record in records)
        high = max(float(np.max(record.input)) for record in records)
        half, middle, most = 0.5 * input_span(records), 0.5 * (low + high), STEEPEST * steepness(records)
        side, tallest = sense(records), TALLEST * output_span(records)
        rising = side > 0 and not falling(records, "")
        sides = [side if k or rising else 0 for k in range(self.plays + 1) for _ in range(self.pieces)]
        return (
            radius_box(radius, records, NARROWEST),
            centre.within(middle - 0.5 * half, middle + 0.5 * half),
            reach.within(0.1 * half, half),
            slope.within(-most, most),
            *(sided(weight, tallest, one) for weight, one in zip(weights, sides, strict=True)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

    @property
    def _nodes(self) -> Array:
        """From the centre, in reaches, (pieces + 1,)."""
        nodes: Array = np.sinh(GRADING * np.linspace(-1.0, 1.0, self.pieces + 1)) / np.sinh(GRADING)
        return nodes

"""The Preisach operator in play form with curves of straight pieces: a density that is read off the data.

[1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), section 2.4.
[2] I. D. Mayergoyz, Mathematical Models of Hysteresis, Springer (1991), section 1.3: what first-order reversal curves
    tell of the density.

Legend: u input, y output, P_r the play of half-width r, w_kj weights.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import STEEPEST, falling, offset, output_span, sense, sided, steepness
from hysteresis_plugins.models._plays import OWN_SHAPES, RADIUS, SLOPE, at_least
from hysteresis_plugins.models._threshold_rate import OFFERS, rated

TALLEST = 2.0
"""Largest rise of one piece, in ranges of the output."""
NARROWEST = 0.02
"""Least radius, in half ranges of the input."""


def _parameters(plays: int, pieces: int) -> tuple[Parameter, ...]:
    weights = (
        Parameter(f"w{k}_{j}", 0.0, 2.0, "{output}", meaning=f"rise of play {k}'s curve along its piece {j}")
        for k in range(plays + 1)
        for j in range(1, pieces + 1)
    )
    return (
        replace(RADIUS, meaning="from the centre to the last node, and above the largest threshold"),
        Parameter("centre", -0.25, 0.25, "{input}", meaning="of the nodes"),
        Parameter("grading", 0.05, 5.0, meaning="of the cells: the largest are cosh of it times the smallest"),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part that does not saturate"),
        *weights,
    )


def _graded(shares: Array, grading: Array) -> Array:
    """-1 to 1 onto -1 to 1, dense about 0, (shares, swarm)."""
    found: Array = np.sinh(shares[:, None] * grading) / np.sinh(grading)
    return found


@dataclass(frozen=True)
class PreisachHats(Model):
    """Preisach in play form with monotone curves of straight pieces: reads a density off reversal curves.

    y = slope u + sum over k = 0 to plays of phi_k(P_rk[u]), r_k = radius s(k / (plays + 1)); phi_k rises by w_kj from
    node j - 1 to node j, and stays outside the nodes [1]; nodes at centre + radius s(x), x even from -1 to 1,
    s(x) = sinh(grading x) / sinh(grading): fine cells about the centre, coarse ones far from it. Many curves with a
    reversal of their own determine the weights [2]. Rate-independent, with wiping out and congruency; linear in slope
    and weights. With weights from 0 up the loop runs anticlockwise, and the curves never fall; the box takes the side
    of the records' loops, for the curve of the input itself either sign where they run clockwise or fall.

    plays : how many besides the input itself, 1 to 40;  pieces : of every curve, 2 to 60

    Ours: so many weights want a smooth density; `roughness` says how rough one is. Give it reversal curves, each with
    the saturation that it comes from as its first samples. Every play starts in the middle of its dead band.
    """

    parameters = _parameters(12, 24)
    linear = tuple(parameter.name for parameter in parameters[3:])
    own_shapes = OWN_SHAPES
    properties = ("rate-independent", "return-point", "congruent")
    offers = OFFERS

    plays: int = 12
    pieces: int = 24

    def __post_init__(self) -> None:
        at_least("plays", self.plays, 1, 40)
        at_least("pieces", self.pieces, 2, 60)
        object.__setattr__(self, "parameters", _parameters(self.plays, self.pieces))
        object.__setattr__(self, "linear", tuple(parameter.name for parameter in self.parameters[3:]))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play_hats import play_hats

        weights = np.concatenate(p[4 : len(self.parameters)]).reshape(self.plays + 1, self.pieces, -1)
        radii, nodes = self.cells(p)
        return play_hats(signal.input, rated(radii, signal, p), nodes, weights, p.slope)

    def cells(self, p: Any) -> tuple[Array, Array]:
        """Thresholds (plays + 1, swarm) and nodes (pieces + 1, swarm), unit of the input."""
        shares = np.arange(self.plays + 1) / (self.plays + 1.0)
        nodes = p.centre + p.radius * _graded(np.linspace(-1.0, 1.0, self.pieces + 1), p.grading)
        return p.radius * _graded(shares, p.grading), np.ascontiguousarray(nodes)

    def roughness(self, p: Any) -> Array:
        """Differences of the density from cell to cell, (rows, linear), each times the root of the cells' areas, so
        that it is a rise: along every curve, and from play to play but for that of the input itself, which stands
        beside the density."""
        radii, nodes = (cells[:, 0] for cells in self.cells(p))
        lengths = np.diff(nodes)
        widths = np.concatenate([[p.radius[0] / (self.plays + 1.0)], np.diff(np.append(radii, p.radius[0]))[1:]])
        areas = widths[:, None] * lengths
        number = np.arange(areas.size).reshape(areas.shape)
        along = (number[:, :-1].ravel(), number[:, 1:].ravel())
        across = (number[1:-1].ravel(), number[2:].ravel())
        ones, others = (np.concatenate(pair) for pair in zip(along, across, strict=True))
        rows, size, area = np.arange(ones.size), np.sqrt(areas.ravel()[ones] * areas.ravel()[others]), areas.ravel()
        found = np.zeros((rows.size, 1 + area.size))
        found[rows, 1 + ones] = size / area[ones]
        found[rows, 1 + others] = -size / area[others]
        return found

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Of the scored input: the radius from a fiftieth of half its span to all of it, the centre in its middle
        tenth; weights up to twice the range of the output, on the side of the loops' sense, on both where the data do
        not say."""
        radius, centre, grading, slope, *weights = self.parameters
        low = min(float(np.min(record.input[record.scored])) for record in records)
        high = max(float(np.max(record.input[record.scored])) for record in records)
        half, middle, most = 0.5 * (high - low) or 1.0, 0.5 * (low + high), STEEPEST * steepness(records)
        side, tallest = sense(records), TALLEST * output_span(records)
        rising = side > 0 and not falling(records, "")
        sides = [side if k or rising else 0 for k in range(self.plays + 1) for _ in range(self.pieces)]
        return (
            radius.within(NARROWEST * half, half),
            centre.within(middle - 0.1 * half, middle + 0.1 * half),
            grading,
            slope.within(-most, most),
            *(sided(weight, tallest, one) for weight, one in zip(weights, sides, strict=True)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

    def density(self, p: Any, places: Array) -> tuple[Array, Array, str]:
        radii, nodes = (cells[:, 0] for cells in self.cells(p))
        rises = np.array(p[4 : len(self.parameters)]).reshape(self.plays + 1, self.pieces)
        piece = np.searchsorted(nodes, places, side="right") - 1
        inside = (piece >= 0) & (piece < self.pieces)
        slopes = (rises / np.diff(nodes))[:, np.clip(piece, 0, self.pieces - 1)]
        return radii[1:], np.where(inside, slopes, 0.0)[1:], SLOPE

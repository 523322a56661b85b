"""The Preisach operator in play form: a sum of curves of play operators.

[1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), section 2.4.
[2] P. Krejčí, Hysteresis, Convexity and Dissipation in Hyperbolic Equations, Gakkotosho (1996), chapter II.3.

Legend: u input, y output, P_r the play of half-width r, a_km coefficients.
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
from hysteresis_plugins.models._data import STEEPEST, input_span, offset, output_span
from hysteresis_plugins.models._plays import OWN_SHAPES, RADIUS, SLOPE, at_least, radius_box, thresholds
from hysteresis_plugins.models._threshold_rate import OFFERS, rated

FAR = 1.5
"""Distance of the input's centre from 0, in half ranges, from which powers of the input are hard to tell apart."""


def _parameters(plays: int, degree: int) -> tuple[Parameter, ...]:
    coefficients = (
        Parameter(
            f"a{k}_{m}",
            -5.0,
            5.0,
            "{output}/{input}" if m == 1 else f"{{output}}/{{input}}^{m}",
            meaning=f"power {m} of the play of half-width {k}/{plays + 1} radius" if k else f"power {m} of the input",
        )
        for k in range(plays + 1)
        for m in range(1, degree + 1)
    )
    return (RADIUS, *coefficients)


def _example(plays: int, degree: int) -> dict[str, float]:
    """Curves that saturate: the cubic term takes a third of the slope at the largest drive."""
    values = {q.name: 0.0 for q in _parameters(plays, degree)[1:]}
    for k in range(plays + 1):
        values[f"a{k}_1"], values[f"a{k}_3"] = 0.3, -0.3 / 16.0 / 9.0
    return {"radius": 4.0, **values}


@dataclass(frozen=True)
class Preisach(Model):
    """Preisach in play form: a sum of polynomials of play operators, linear in all their coefficients.

    y = sum over k = 0 to plays of phi_k(P_rk[u]), phi_k(x) = sum over m = 1 to degree of a_km x^m,
    r_k = radius k / (plays + 1) [1, 2]: every Preisach operator is such a sum in the limit. Rate-independent, with
    wiping out and congruency; of either sense. Prandtl-Ishlinskii has straight phi_k.

    plays : how many besides the input itself, 1 to 40;  degree : of the polynomials, 1 to 7

    Ours: the radius is a parameter that ends at half the range of the input, so that no threshold lies where the data
    never were; every play starts in the middle of its dead band. A polynomial is no law beyond the range of the fitted
    records. The constant is the effect bias, or record-offset.
    """

    parameters = _parameters(5, 3)
    linear = tuple(parameter.name for parameter in parameters[1:])
    own_shapes = OWN_SHAPES
    properties = ("rate-independent", "return-point", "congruent")
    offers = OFFERS
    example = Example(4.0, _example(5, 3), stream=7, without=("threshold-rate",))

    plays: int = 5
    degree: int = 3

    def __post_init__(self) -> None:
        at_least("plays", self.plays, 1, 40)
        at_least("degree", self.degree, 1, 7)
        object.__setattr__(self, "parameters", _parameters(self.plays, self.degree))
        object.__setattr__(self, "linear", tuple(parameter.name for parameter in self.parameters[1:]))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play_bank import play_bank

        rows = np.stack([getattr(p, name) for name in self.linear])
        coefficients = rows.reshape(self.plays + 1, self.degree, -1)
        return play_bank(signal.input, rated(thresholds(p.radius, self.plays), signal, p), coefficients)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The radius at most half the span of the input; coefficients of either sign, so large that a polynomial
        about the input's centre, 50 times as steep as the data, is inside."""
        radius, *coefficients = self.parameters
        half, far = 0.5 * input_span(records), 1.0 + abs(_centre(records)) / (0.5 * input_span(records))
        most = [
            STEEPEST * output_span(records) * far ** (self.degree - m) / half**m
            for _ in range(self.plays + 1)
            for m in range(1, self.degree + 1)
        ]
        return (
            radius_box(radius, records),
            *(one.within(-edge, edge) for one, edge in zip(coefficients, most, strict=True)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        centre = _centre(records)
        if abs(centre) > FAR * 0.5 * input_span(records) and self.degree > 1:
            return (
                *offset(records),
                f"The input's centre {centre:.4g} is far from 0, where the powers of the input are hard to tell "
                "apart. Use --input-offset.",
            )
        return offset(records)

    def density(self, p: Any, places: Array) -> tuple[Array, Array, str]:
        rows = np.array([getattr(p, name)[0] for name in self.linear]).reshape(self.plays + 1, self.degree)[1:]
        powers = np.arange(1, self.degree + 1)[:, None]
        return thresholds(p.radius, self.plays)[1:, 0], rows @ (powers * places ** (powers - 1)), SLOPE


def _centre(records: Sequence[Record]) -> float:
    low = min(float(np.min(record.input)) for record in records)
    high = max(float(np.max(record.input)) for record in records)
    return 0.5 * (low + high)

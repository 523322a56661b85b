"""Dahl's solid friction, beside a spring and behind a clearance.

[1] P. R. Dahl, A solid friction model, Aerospace Corporation, TOR-158(3107-18) (1968).

Legend: u displacement, F force, F_C Coulomb's force, distance F_C over the stiffness at rest, i the exponent.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Example, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import STEEPEST, input_span, offset, output_span, sense, sided, steepness

STRONGEST = 5.0
"""Largest friction, in ranges of the output."""


@dataclass(frozen=True)
class Dahl(Model):
    """Dahl friction: a spring, and a force that builds up to Coulomb's along the way; linear in both.

    F = slope u + F_C z, dz/du = |1 - z sgn(u')|^i / distance [1]. Rate-independent. With F_C >= 0 it is passive and
    its loop runs clockwise, force over displacement; with F_C <= 0 anticlockwise. The box takes the side on which the
    records' loops run.

    Ours: a clearance of twice the gap in series, which leaves a plateau of no friction after a reversal; gap = 0 is
    Dahl's. z = 0 at the first sample. The constant is the effect bias, or record-offset.
    """

    parameters = (
        Parameter("distance", 1e-3, 1.0, "{input}", "log", meaning="over which friction builds up", positive=True),
        Parameter("i", 0.1, 3.0, meaning="exponent: below 1 for brittle, above for ductile contacts"),
        Parameter("gap", 0.0, 0.2, "{input}", meaning="half of the clearance that is crossed without friction"),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part without hysteresis"),
        Parameter("F_C", 0.0, 5.0, "{output}", meaning="Coulomb friction"),
    )
    linear = ("slope", "F_C")
    properties = ("rate-independent", "odd")
    example = Example(
        4.0, {"distance": 0.8, "i": 1.0, "gap": 0.0, "slope": 0.4, "F_C": 1.5}, stream=9, without=("input-bias",)
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.dahl import dahl

        friction = dahl(signal.input, p.distance, p.i, p.gap)
        friction *= p.F_C
        friction += p.slope * signal.input
        return friction

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The distance from a thousandth of the span of the input to all of it, the gap up to a fifth; friction up to
        five times the range of the output, on the side of the loops' sense, on both where the data do not say."""
        distance, i, gap, slope, coulomb = self.parameters
        span, most = input_span(records), STEEPEST * steepness(records)
        return (
            distance.within(1e-3 * span, span),
            i,
            gap.within(0.0, 0.2 * span),
            slope.within(-most, most),
            sided(coulomb, STRONGEST * output_span(records), -sense(records)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

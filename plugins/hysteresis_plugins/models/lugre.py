"""LuGre friction: bristles that bend and slip, with static and viscous friction.

[1] C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, IEEE Trans. Automatic Control 40 (1995) 419.

Legend: u displacement, v = du/dt, F force, z the bristles' force over F_C, distance F_C / sigma_0, v_s the Stribeck
velocity, stiction F_S / F_C.
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

STRONGEST = 5.0
"""Largest friction, and largest force of a rate, in ranges of the output."""


@dataclass(frozen=True)
class Lugre(Model):
    """LuGre friction: a spring, bristles that slip, and forces of the velocity; linear in the four forces.

    F = slope u + F_C z + sigma_1 distance dz/dt + sigma_2 v,
    distance dz/dt = v - |v| z / r(v), r(v) = 1 + (stiction - 1) exp(-(v/v_s)²) [1].

    Rate-dependent: the loop changes with the velocity. Not passive for every sigma_1: the literature has it fall with
    the velocity where that matters. Where time is only an index it is Dahl's friction with i = 1: v counts as fast,
    and the forces of the velocity are 0. The box of the forces takes the side on which the records' loops run.

    Ours: z = 0 at the first sample; v at a sample is the central difference of the displacement. The constant is the
    effect bias, or record-offset.
    """

    parameters = (
        Parameter("distance", 1e-3, 1.0, "{input}", "log", meaning="over which bristles bend", positive=True),
        Parameter("stiction", 0.1, 3.0, meaning="static friction over Coulomb's", positive=True),
        Parameter("v_s", 1e-2, 10.0, "{input}/{time}", "log", meaning="Stribeck velocity", positive=True),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part without hysteresis"),
        Parameter("F_C", 0.0, 5.0, "{output}", meaning="Coulomb friction"),
        Parameter("sigma_1", 0.0, 1.0, "{output} {time}/{input}", meaning="damping of the bristles"),
        Parameter("sigma_2", 0.0, 1.0, "{output} {time}/{input}", meaning="viscous friction"),
    )
    linear = ("slope", "F_C", "sigma_1", "sigma_2")
    properties = ("odd",)
    example = Example(
        4.0,
        {"distance": 0.8, "stiction": 1.3, "v_s": 8.0, "slope": 0.4, "F_C": 1.5, "sigma_1": 0.003, "sigma_2": 0.004},
        stream=10,
        without=("input-bias",),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.lugre import lugre

        force, bending, v = lugre(signal.time, signal.timed, signal.input, p.distance, p.stiction, p.v_s)
        force *= p.F_C
        bending *= p.sigma_1
        v *= p.sigma_2
        force += bending
        force += v
        force += p.slope * signal.input
        return force

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The distance from a thousandth of the span of the input to all of it, the Stribeck velocity from a
        thousandth of a velocity that one sample in twenty exceeds to all of it; forces up to five times the range of
        the output, on the side of the loops' sense, on both where the data do not say."""
        distance, stiction, slowest, slope, *forces = self.parameters
        span, side = input_span(records), -sense(records)
        fastest, strongest, most = _fastest(records), STRONGEST * output_span(records), STEEPEST * steepness(records)
        return (
            distance.within(1e-3 * span, span),
            stiction,
            slowest.within(1e-3 * fastest, fastest),
            slope.within(-most, most),
            sided(forces[0], strongest, side),
            sided(forces[1], strongest / fastest, side),
            sided(forces[2], strongest / fastest, side),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        if not all(record.timed for record in records):
            return (
                *offset(records),
                "Time is only an index here: nothing of the velocity can be told; use dahl, or maxwell-slip.",
            )
        return offset(records)


def _fastest(records: Sequence[Record]) -> float:
    """A velocity that one sample in twenty exceeds, 1 where nothing moves."""
    speeds = [np.abs(np.diff(record.input) / np.diff(record.time)) for record in records if record.time.size > 1]
    return max((float(np.quantile(speed, 0.95)) for speed in speeds), default=0.0) or 1.0

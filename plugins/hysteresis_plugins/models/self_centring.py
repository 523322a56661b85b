"""Self-centring: an elastic curve that bends once on either side, beside friction or yielding.

[1] C. Christopoulos, A. Filiatrault, B. Folz, Earthquake Eng. Struct. Dyn. 31 (2002) 1131: such structures.
[2] M. Menegotto, P. E. Pinto, IABSE Reports 13 (1973) 15: the rounded corner.
[3] P. R. Dahl, A solid friction model, Aerospace Corporation, TOR-158(3107-18) (1968).

Legend: u displacement, F force, w the way from the centre, z the force of what yields over its strength, M the largest
way so far over u_r.
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
from hysteresis_plugins.models._data import STEEPEST, in_the_middle, input_span, offset, output_span, steepness

STRONGEST = 5.0
"""Largest forces, in ranges of the output."""


@dataclass(frozen=True)
class SelfCentring(Model):
    """Self-centring: as a rocking wall that is held down by tendons, beside parts that yield wherever it stands.

    F = up max(w, 0) + down min(w, 0) + (F_r - loss M^q) e(w / u_r) + F_y z, w = u - centre,
    e(x) = x / (1 + |x|^m)^(1/m) [1, 2], dz/du = |1 - z sgn(u')|^i / u_y [3], M the largest |w| / u_r so far on the side
    of w. Rate-independent, linear in both slopes and all forces; its loop runs clockwise, force over displacement.

    Ours: slopes of their own on either side, a rounded yielding, and a bend that loses force with the largest way on
    its side, as where toes are crushed or tendons yield: of a measured wall a law of the ways on both sides together
    predicted to 2880 N, this one to 2320 (prototypes). z = 0 and M = 0 at the first sample. The constant is the effect
    bias, or record-offset.
    """

    parameters = (
        Parameter("u_r", 1e-2, 2.0, "{input}", "log", meaning="way from the centre to the bend", positive=True),
        Parameter("m", 0.5, 20.0, scaling="log", meaning="sharpness of the bend", positive=True),
        Parameter("centre", -0.2, 0.2, "{input}", meaning="where it comes to rest"),
        Parameter("u_y", 1e-3, 1.0, "{input}", "log", meaning="displacement of yielding, F_y over k", positive=True),
        Parameter("i", 0.1, 3.0, meaning="roundness of yielding; at 0 it is sharp"),
        Parameter("up", -5.0, 5.0, "{output}/{input}", meaning="slope above the bend"),
        Parameter("down", -5.0, 5.0, "{output}/{input}", meaning="slope below the bend of the other side"),
        Parameter("F_r", -5.0, 5.0, "{output}", meaning="force of the bend"),
        Parameter("F_y", 0.0, 5.0, "{output}", meaning="strength of what yields"),
        Parameter("loss", 0.0, 5.0, "{output}", meaning="force that the bend has lost after a way of u_r"),
        Parameter("q", 0.1, 3.0, meaning="power of the largest way with which it is lost", positive=True),
    )
    linear = ("up", "down", "F_r", "F_y", "loss")
    properties = ("rate-independent",)
    senses = (-1,)
    example = Example(
        4.0,
        {
            "u_r": 0.6,
            "m": 3.0,
            "centre": 0.05,
            "u_y": 0.4,
            "i": 1.0,
            "up": 0.3,
            "down": 0.3,
            "F_r": 1.5,
            "F_y": 0.4,
            "loss": 0.1,
            "q": 0.7,
        },
        stream=19,
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.dahl import dahl
        from hysteresis_bench.kernels.self_centring import self_centring

        force = dahl(signal.input, p.u_y, p.i, np.zeros_like(p.u_y))
        self_centring(signal.input, force, np.stack([p.centre, p.u_r, p.m, p.up, p.down, p.F_r, p.F_y, p.loss, p.q]))
        return force

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Displacements of the bend and of yielding from a thousandth of the span of the input to all of it, the
        centre in its middle fifth; forces up to five times the range of the output."""
        boxes = {q.name: q for q in self.parameters}
        span, most, forces = input_span(records), STEEPEST * steepness(records), STRONGEST * output_span(records)
        inside = {
            "u_r": boxes["u_r"].within(1e-3 * span, span),
            "centre": in_the_middle(boxes["centre"], records),
            "u_y": boxes["u_y"].within(1e-3 * span, span),
            "up": boxes["up"].within(-most, most),
            "down": boxes["down"].within(-most, most),
            "F_r": boxes["F_r"].within(-forces, forces),
            "F_y": boxes["F_y"].within(0.0, forces),
            "loss": boxes["loss"].within(0.0, forces),
        }
        return tuple(inside.get(name, box) for name, box in boxes.items())

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

"""Flag-shaped: superelastic bars, friction beside tendons: on the way back the force is less, and gone in the centre.

[1] C. Christopoulos, A. Filiatrault, B. Folz, Earthquake Eng. Struct. Dyn. 31 (2002) 1131: the flag-shaped loop.
[2] M. Menegotto, P. E. Pinto, IABSE Reports 13 (1973) 15: the rounded corner.

Legend: u displacement, F force, w the way from the centre, x the spring's part of it. In [1] the bend is F_y / k_0,
up and down are k_0 (1 - alpha), slope is alpha k_0.
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
from hysteresis_plugins.models._data import STEEPEST, in_the_middle, input_span, offset, steepness


@dataclass(frozen=True)
class FlagShaped(Model):
    """Flag-shaped: a spring between the curve on which it is loaded and a lower one on which it comes back [1].

    |x| follows |w| step for step between (1 - beta) u_y e(|w| / ((1 - beta) u_y)) and u_y e(|w| / u_y), w = u - centre,
    e(a) = a / (1 + a^m)^(1/m) [2];  F = up x + slope w above the centre, down x + slope w below it. Rate-independent,
    passive, linear in up, down and slope; its loop runs clockwise, force over displacement.

    Ours: corners may be round (those of [1] are sharp, m without end), and each side has a stiffness of its own.
    The spring rests in the centre before the first sample. The constant is the effect bias, or record-offset.
    """

    parameters = (
        Parameter("u_y", 1e-2, 2.0, "{input}", "log", meaning="way from the centre to the bend", positive=True),
        Parameter("beta", 0.0, 1.0, meaning="share of the bend's force that is gone on the way back"),
        Parameter("m", 1.0, 100.0, scaling="log", meaning="sharpness of the bends", positive=True),
        Parameter("centre", -0.2, 0.2, "{input}", meaning="where it comes to rest"),
        Parameter("up", 0.0, 5.0, "{output}/{input}", meaning="added to slope above the centre, up to the bend"),
        Parameter("down", 0.0, 5.0, "{output}/{input}", meaning="added to slope below the centre, up to the bend"),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="stiffness beyond the bend"),
    )
    linear = ("up", "down", "slope")
    properties = ("rate-independent",)
    senses = (-1,)
    example = Example(
        4.0,
        {"u_y": 0.8, "beta": 0.6, "m": 8.0, "centre": 0.05, "up": 1.0, "down": 1.0, "slope": 0.1},
        stream=24,
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.flag_shaped import flag_shaped

        force = np.empty((signal.input.shape[0], p.u_y.size))
        flag_shaped(signal.input, np.stack([p.centre, p.u_y, 1.0 - p.beta, p.m, p.up, p.down, p.slope]), force)
        return force

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The bend from a thousandth of the span of the input to all of it, the centre in its middle fifth."""
        boxes = {q.name: q for q in self.parameters}
        span, most = input_span(records), STEEPEST * steepness(records)
        inside = {
            "u_y": boxes["u_y"].within(1e-3 * span, span),
            "centre": in_the_middle(boxes["centre"], records),
            "up": boxes["up"].within(0.0, most),
            "down": boxes["down"].within(0.0, most),
            "slope": boxes["slope"].within(-most, most),
        }
        return tuple(inside.get(name, box) for name, box in boxes.items())

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)

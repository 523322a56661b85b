"""Cyclic plasticity of a metal coupon that bows under compression.

[1] R. P. Dhakal, K. Maekawa, J. Structural Engineering 128 (2002) 1139: bars that buckle between reversals, their mean
    stress over the mean strain.

Legend: u strain between the gauges, u_a that of the metal, stress the output, v compression beyond u_b; all else as in
`chaboche`.
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
from hysteresis_plugins.models._data import STEEPEST, falling, input_span, offset, steepness
from hysteresis_plugins.models.chaboche import Chaboche, over_modulus

MOST = 0.9
"""Of a compression that goes into bowing: none bows without being shortened."""
STRONGEST = 4.0
"""Largest bow, over the span of the input."""
LEAST = 1e-300
"""Least of what is divided by."""
LATEST = 0.35
"""Largest compression without any bow, in spans of the input."""


@dataclass(frozen=True)
class ChabocheBowed(Model):
    """Chaboche, of a coupon that bows under compression: a part of the strain bends it, and it carries less.

    stress = (E + loss min(u, 0)) s(u_a), s of `chaboche` over E, du_a/du = 1 - min(bow v, 0.9), v = max(-u - u_b, 0).
    Rate-independent, linear in E and loss; its loop runs clockwise, stress over strain.

    Ours: both formulas; those of the literature are of slender bars [1]. They are made for one measured coupon of
    structural steel, which keeps half of its stiffness where it is pushed ever further, and most of it where it is
    pulled. The strain is 0 where the coupon is straight. The constant is the effect bias, or record-offset.
    """

    parameters = (
        *Chaboche.parameters,
        Parameter("bow", 0.0, 1.0, "1/{input}", meaning="growth of the share of compression that goes into bowing"),
        Parameter("u_b", 0.0, 1.0, "{input}", meaning="compression from which it bows"),
        Parameter("loss", 0.0, 5.0, "{output}/{input}^2", meaning="modulus that compression takes away"),
    )
    linear = ("E", "loss")
    properties = ("rate-independent",)
    senses = (-1,)
    example = Example(4.0, {**Chaboche.example.parameters, "bow": 0.1, "u_b": 1.0, "loss": 0.1}, stream=31)

    def simulate(self, signal: Signal, p: Any) -> Array:
        u = signal.input
        stress = over_modulus(np.ascontiguousarray(strain_of_the_metal(u, p)), p)
        stress *= p.E + p.loss * np.minimum(u, 0.0)
        return stress

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Of `chaboche`; all of a compression bows at a quarter of the span of the input at the earliest, from a
        third of it at the latest, and takes away the largest modulus over it at most."""
        span, known = input_span(records), Chaboche().box(records)
        bow, begin, loss = self.parameters[len(known) :]
        return (
            *known,
            bow.within(0.0, STRONGEST / span),
            begin.within(0.0, LATEST * span),
            loss.within(0.0, STEEPEST * steepness(records) / span),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return falling(records, "the stress of this law rises with the strain") or offset(records)


def strain_of_the_metal(u: Array, p: Any) -> Array:
    """u_a, (samples, swarm);  u : (samples, 1) or (samples, swarm)"""
    compression = np.maximum(-u - p.u_b, 0.0)
    bowing = np.minimum(compression, MOST / np.maximum(p.bow, LEAST))
    metal: Array = u + p.bow * bowing * (compression - 0.5 * bowing)
    return metal

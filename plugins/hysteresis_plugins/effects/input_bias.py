"""Input bias: one constant on the input of all records, as a stray field, an imprint or a preload."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import input_span, motionless

FARTHEST = 0.25
"""Of the range of the input."""


def _constant(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u + 0.2 * hiding.strength * hiding.amplitude * np.sign(hiding.random[0] - 0.5))


@dataclass(frozen=True)
class InputBias(Effect):
    """One constant that acts beside the input: v = u + offset, the model sees v.

    A stray field, the imprint of a ferroelectric film [1], a preload, or a zero of the input's sensor that is off. Of a
    law for which only changes of the input matter, it is a constant of the output.

    [1] A. K. Tagantsev, L. E. Cross, J. Fousek, Domains in Ferroic Crystals and Thin Films, Springer (2010), section 9.
    """

    acts = "input"
    family = "curve of the input"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "asymmetry": "both let one sign of the input reach further than the other",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_constant,)
    parameters = (Parameter("offset", -0.5, 0.5, "{input}", null=0.0, meaning="that acts beside the input"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not np.any(p.offset):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(signal.input + p.offset))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to a quarter of the range of the input to either side."""
        farthest = FARTHEST * (input_span(records) or 1.0)
        return (self.parameters[0].within(-farthest, farthest),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

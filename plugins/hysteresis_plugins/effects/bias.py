"""Bias: one constant on the output of all records."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import input_span, largest_input


@dataclass(frozen=True)
class Bias(Effect):
    """One constant on the output of all records: y + offset."""

    acts = "added"
    family = "curve of the output"
    nuisance = True
    affine = True
    linear = ("offset",)
    parameters = (Parameter("offset", -1.0, 1.0, unit="{output}", null=0.0, meaning="added to the output"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        shifted: Array = inner(signal) + p.offset
        return shifted

    def offset(self, simulated: Array, record: Record, p: Any) -> Array:
        return np.asarray(p.offset)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        low = min(float(np.min(record.measured)) for record in records)
        high = max(float(np.max(record.measured)) for record in records)
        # the constant may lie as far outside the measured range as the range is wide, and as far as a response in
        # proportion to an input far from zero
        span = (high - low) or 1.0
        far = span * max(1.0, largest_input(records) / (input_span(records) or 1.0))
        return (self.parameters[0].within(low - far, high + far),)

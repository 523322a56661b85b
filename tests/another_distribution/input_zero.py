"""A nuisance as somebody else would write it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter


@dataclass(frozen=True)
class InputZero(Effect):
    """The zero of the input's sensor: u + zero."""

    acts = "input"
    family = "curve of the input"
    nuisance = True
    parameters = (Parameter("zero", -1.0, 1.0, "{input}", null=0.0, meaning="added to the input"),)

    def apply(self, inner, signal, p):
        return inner(signal.with_input(signal.input + p.zero)) if np.any(p.zero) else inner(signal)

    def box(self, records):
        widest = 0.2 * max(float(np.ptp(record.input)) for record in records)
        return (self.parameters[0].within(-widest, widest),)

"""An effect as somebody else would write it: one file, one entry point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter


def _bent(inner, u, hiding):
    """By the exponential of which the parabola is the beginning."""
    y, bend = inner(u), 0.6 * hiding.strength / abs(hiding.top)
    return np.expm1(2.0 * bend * y) / (2.0 * bend)


@dataclass(frozen=True)
class OutputBend(Effect):
    """An even nonlinearity of the output: y + bend y²."""

    acts = "output"
    family = "curve of the output"
    mistaken_for = {"asymmetry": "both bend the loop to one side"}  # noqa: RUF012
    hidden_forms = (_bent,)
    parameters = (Parameter("bend", -1.0, 1.0, "1/{output}", null=0.0, meaning="of the response"),)

    def apply(self, inner, signal, p):
        output = inner(signal)
        return output + p.bend * output**2

    def box(self, records):
        steepest = 0.9 / max(float(np.ptp(record.measured)) for record in records)
        return (self.parameters[0].within(-steepest, steepest),)

"""Rayleigh's hysteresis: walls pinned at every strength answer a larger input more than in proportion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import input_span, motionless, output_span

PLAYS = 200


def plays(u: Array, widest: float) -> Array:
    """The irreversible part of Rayleigh's law as equally dense play operators, half widths from 0 to the widest that
    moves; u : (samples,), the virgin curve starts at the first sample."""
    half = (np.arange(PLAYS) + 0.5) * widest / PLAYS
    body, out = np.full(PLAYS, float(u[0])), np.empty_like(u)
    for k, middle in enumerate(u.tolist()):
        np.clip(body, middle - half, middle + half, out=body)
        out[k] = np.mean(body)
    grown: Array = widest * (out - u[0])
    return grown


def _plays(inner: Response, u: Array, hiding: Hiding) -> Array:
    largest = 2.0 * hiding.strength * hiding.top / hiding.amplitude**2
    return inner(u) + largest * plays(u, float(np.ptp(u)))


@dataclass(frozen=True)
class RayleighHysteresis(Effect):
    """Parabolic loops beside those of the model, as pinned domain walls in ferroelectrics and magnets make them.

    y = x + coefficient r[u], x the response, r the irreversible part of Rayleigh's law [1]: u²/2 on the virgin
    curve, and (u - u_t)²/4 from a turning point u_t on. The loop's area grows with the amplitude cubed and the
    slope of minor loops with the amplitude, which is what piezoelectric ceramics show below the coercive field [2]
    and what a model with one smooth loop lacks. Ours: the virgin curve starts at the first sample.

    [1] Lord Rayleigh, Phil. Mag. 23 (1887) 225.
    [2] D. Damjanovic, M. Demartin, J. Phys. D 29 (1996) 2057.
    """

    acts = "law"
    family = "law"
    affine = True
    linear = ("coefficient",)
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_plays,)
    parameters = (
        Parameter("coefficient", 0.0, 1.0, "{output}/{input}^2", null=0.0, meaning="growth of the slope of loops"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.rayleigh import rayleigh

        output = inner(signal)
        return output + p.coefficient * rayleigh(signal.input) if np.any(p.coefficient) else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to twice what makes the whole output of the largest loop."""
        span = input_span(records) or 1.0
        return (self.parameters[0].within(0.0, 8.0 * (output_span(records) or 1.0) / span**2),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

"""Cubic stiffness: a spring beside the hysteresis that hardens or softens."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import largest_input, motionless, output_span


def _sign(hiding: Hiding) -> float:
    return 1.0 if hiding.random[0] > 0.5 else -1.0


def _cubic(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + _sign(hiding) * 0.4 * hiding.strength * hiding.top * (u / hiding.amplitude) ** 3


def _fifth_power(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + _sign(hiding) * 0.4 * hiding.strength * hiding.top * (u / hiding.amplitude) ** 5


def _bumper(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A straight spring that is met where half the largest input is passed, on either side."""
    pressed: Array = u - np.clip(u, -0.5 * hiding.amplitude, 0.5 * hiding.amplitude)
    return inner(u) + 0.8 * hiding.strength * hiding.top * pressed / hiding.amplitude


@dataclass(frozen=True)
class CubicStiffness(Effect):
    """A spring beside the hysteresis hardens or softens: a cubic of the input is added to the output.

    y = x + cubic u³, x the response: the restoring force of Duffing's oscillator [1] less its straight part, which is
    the law's own; beside Bouc-Wen hysteresis as of vibration isolators [2]. u³ counts from the input's own zero.

    [1] I. Kovacic, M. J. Brennan (eds.), The Duffing Equation, Wiley (2011).
    [2] F. Ikhouane, J. Rodellar, Systems with Hysteresis, Wiley (2007).
    """

    acts = "law"
    family = "curve beside the law"
    affine = True
    linear = ("cubic",)
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "saturation": "of a thin loop, a bend of the output and a cubic of the input are the same to first order",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_cubic,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_fifth_power, _bumper)
    parameters = (
        Parameter("cubic", -1.0, 1.0, "{output}/{input}^3", null=0.0, meaning="restoring force over the cubed input"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output, u = inner(signal), signal.input
        return output + p.cubic * (u * u * u) if np.any(p.cubic) else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to a spring that makes twice the output's range at the largest input."""
        largest = 2.0 * (output_span(records) or 1.0) / (largest_input(records) or 1.0) ** 3
        return (self.parameters[0].within(-largest, largest),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

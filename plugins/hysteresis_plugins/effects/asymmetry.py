"""Asymmetry: both directions of the input do not act alike."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import largest_input, motionless


def _signed(inner: Response, u: Array, hiding: Hiding) -> Array:
    bend = np.sign(hiding.random[0] - 0.5) * 0.45 * hiding.strength
    return inner(u * (1.0 + bend * u / hiding.amplitude))


def _bent(inner: Response, u: Array, hiding: Hiding) -> Array:
    bend = (0.1 + 0.2 * hiding.strength) * (1 if hiding.random[0] > 0.5 else -1)
    return inner(u * (1.0 + bend * u / hiding.amplitude))


def _exponential(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A diode's characteristic: every order, odd ones too."""
    bend = 1.2 * hiding.strength * np.sign(hiding.random[0] - 0.5)
    return inner(np.expm1(bend * u / hiding.amplitude) * hiding.amplitude / bend)


def _two_slopes(inner: Response, u: Array, hiding: Hiding) -> Array:
    """One gain above zero, another one below."""
    return inner(u * (1.0 + 0.4 * hiding.strength * np.sign(u)))


@dataclass(frozen=True)
class Asymmetry(Effect):
    """An even nonlinearity of the input: its two signs do not act alike.

    v = u + curvature u², the model sees v: the first even term of a static nonlinearity before the hysteresis,
    as in Hammerstein models [1]. u² counts from the input's own zero.

    Monotone while |u| < 1 / (2 |curvature|), which the box derived from the data guarantees with a margin of a tenth
    for the inputs it was derived from.

    [1] F. Giri, E.-W. Bai (eds.), Block-oriented Nonlinear System Identification, Springer (2010).
    """

    acts = "input"
    family = "curve of the input"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "saturation": (
            "off the middle of the loop, a bend of the input and a bend of the output are the same to first order"
        ),
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_signed, _bent)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_exponential, _two_slopes)
    parameters = (Parameter("curvature", -0.45, 0.45, "1/{input}", null=0.0, meaning="of the input's action"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.asymmetry import bend

        if not np.any(p.curvature):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(bend(signal.input, p.curvature)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to nine tenths of where the largest input would turn back."""
        largest = 0.45 / (largest_input(records) or 1.0)
        return (self.parameters[0].within(-largest, largest),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

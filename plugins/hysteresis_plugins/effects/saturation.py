"""Saturation: the output cannot leave a range."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import output_span

CLIP = 1000.0


def _gentle(inner: Response, u: Array, hiding: Hiding) -> Array:
    twice = 2.0 * hiding.strength
    return np.tanh(twice * inner(u) / hiding.top) * hiding.top / twice


def _strong(inner: Response, u: Array, hiding: Hiding) -> Array:
    level = hiding.top * (0.35 + 0.2 * (1.0 - hiding.strength))
    return level * np.tanh(inner(u) / level)


def _arctangent(inner: Response, u: Array, hiding: Hiding) -> Array:
    steep = 2.0 * hiding.strength / hiding.top
    return np.arctan(steep * inner(u)) / steep


def _langevin(inner: Response, u: Array, hiding: Hiding) -> Array:
    """3 L(x), L(x) = coth(x) - 1/x: dipoles that turn into a field. Its end comes as slowly as 1/x."""
    steep = 6.0 * hiding.strength / hiding.top
    x = steep * inner(u)
    small = np.abs(x) < 1e-2  # x (1 - x²/15) to 1e-10, where the difference has no digits left
    safe = np.where(small, 1.0, x)
    bent: Array = np.where(small, x * (1.0 - x**2 / 15.0), 3.0 * (1.0 / np.tanh(safe) - 1.0 / safe)) / steep
    return bent


@dataclass(frozen=True)
class Saturation(Effect):
    """A smooth, symmetric saturation of the output, such as an amplifier's or a mechanical stop's.

    y = x / (1 + |k x|^n)^(1/n), x the response, k = inverse_level: |y| stays below 1/k [1].

    n, the sharpness, goes from a gentle bend (1) over nearly tanh (2.7) to a clip (1000): at its corner y is
    2^(-1/n) of the level, 3.4 % too low with 20, which noise of 1 % does not hide, 0.07 % with 1000. The level counts
    from the response's zero, so offsets (`bias`) belong outside. Near the null the effect is of the
    order (k x)^n: it grows without a jump, and a search has to start away from 0 to feel it.

    [1] C. Rapp, Effects of HPA-nonlinearity on a 4-DPSK/OFDM-signal for a digital sound broadcasting system,
    2nd European Conference on Satellite Communications (1991) 179-184.
    """

    acts = "output"
    family = "curve of the output"
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_gentle, _strong)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_arctangent, _langevin)
    parameters = (
        Parameter("inverse_level", 0.0, 1.0, "1/{output}", null=0.0, meaning="1 / the largest |output|"),
        Parameter("sharpness", 1.0, CLIP, scaling="log", meaning="of the bend, n", limit=CLIP),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.saturation import saturate

        output = own(inner(signal), signal)
        saturate(output, p.inverse_level, p.sharpness)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Levels from 0.3 times the output's range. Less than half of it a symmetric output would not pass, unless
        something is added to it behind, or multiplies it."""
        inverse_level, sharpness = self.parameters
        return inverse_level.within(0.0, 1.0 / (0.3 * (output_span(records) or 1.0))), sharpness

    def inapplicable(self, records: Sequence[Record]) -> str:
        return "the output never moves" if output_span(records) == 0.0 else ""

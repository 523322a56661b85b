"""Backlash: a clearance between the input and what it moves."""

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


def _clipped(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A body that is kept between two walls around it."""
    half = 0.25 * hiding.strength * hiding.amplitude
    out, body = np.empty_like(u), float(u[0])
    for k, middle in enumerate(u.tolist()):
        body = min(max(body, middle - half), middle + half)
        out[k] = body
    return inner(out)


def _pushed(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A body that is pushed by two walls that move with the input."""
    half = (0.3 + 0.15 * hiding.strength) * hiding.amplitude
    out, body = np.empty_like(u), float(u[0])
    for k, wall in enumerate(u.tolist()):
        if wall - half > body:
            body = wall - half
        elif wall + half < body:
            body = wall + half
        out[k] = body
    return inner(out)


def _compliant(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Two thirds of the motion cross a clearance, the rest goes through a spring beside it."""
    half = 0.35 * hiding.strength * hiding.amplitude
    return inner((u + 2.0 * _between_walls(u, half)) / 3.0)


def _worn_teeth(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Clearances of three widths beside each other."""
    half = 0.3 * hiding.strength * hiding.amplitude
    return inner(np.mean([_between_walls(u, half * width) for width in (0.4, 1.0, 1.6)], axis=0))


def _between_walls(u: Array, half: float) -> Array:
    out, body = np.empty_like(u), float(u[0])
    for k, middle in enumerate(u.tolist()):
        body = min(max(body, middle - half), middle + half)
        out[k] = body
    return out


@dataclass(frozen=True)
class Backlash(Effect):
    """A dead band on the input, such as a gear's clearance: after a reversal it first has to be crossed.

    p_i = max(u_i - r, min(u_i + r, p_{i-1})), r = half_width, the model sees p [1]: the play operator, exact
    for an input that is monotone between its samples. Ours: it starts in the middle of the band, p_0 = u_0.

    [1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
    """

    acts = "input"
    family = "law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "rayleigh-hysteresis": "both make the loop wider with the amplitude",
        "input-lag": "at one amplitude and frequency both shift the loop after a reversal",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_clipped, _pushed)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_compliant, _worn_teeth)
    parameters = (Parameter("half_width", 0.0, 1.0, "{input}", null=0.0, meaning="of the dead band"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play import play

        if not np.any(p.half_width):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(play(signal.input, p.half_width)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to 0.4 times the range of the input; 0.5 would let no motion through."""
        return (self.parameters[0].within(0.0, 0.4 * (input_span(records) or 1.0)),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

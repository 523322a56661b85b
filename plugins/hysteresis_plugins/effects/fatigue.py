"""Fatigue: the amplitude falls with the path travelled."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import path
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import input_span, motionless

SHORTEST = 4.0
"""Paths of the input, in ranges of it, below which a decay looks like a part of the loop: two cycles."""


def _tired(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) * np.exp2(-3.0 * hiding.strength * (path(hiding.drive) / (40.0 * hiding.amplitude)))


def _worn(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) * np.exp2(-(0.3 + 0.5 * hiding.strength) * (path(hiding.drive) / (20.0 * hiding.amplitude)))


def _levelling(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A shakedown: the loss levels off after a few cycles."""
    passed = path(hiding.drive) / (12.0 * hiding.amplitude)
    return inner(u) * (1.0 + 0.8 * hiding.strength * np.expm1(-passed))


def _power(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A power of the path, quick at first and never at an end."""
    return inner(u) * (1.0 + path(hiding.drive) / (2.0 * hiding.amplitude)) ** (-0.5 * hiding.strength)


@dataclass(frozen=True)
class Fatigue(Effect):
    """The amplitude of the output falls exponentially with the path that the input has travelled.

    y = x exp(-rate s), s = sum |u_i - u_(i-1)| since the first sample of the record, x the response: a
    damage that grows with every cycle in proportion to its amplitude and to what is left, as in the
    strength degradation of cyclic plasticity and Bouc-Wen models [1, there with the dissipated energy].

    A record counts its own path, as it restarts the model. Noise on the input adds to the path.

    [1] T. T. Baber, Y.-K. Wen, Random vibration of hysteretic, degrading systems, Journal of the Engineering
    Mechanics Division 107 (1981) 1069-1087.
    """

    acts = "output"
    family = "change with time, path or temperature"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "drift": "over one cycle count and amplitude, a loop that shrinks also moves its ends",
        "temperature-sensitivity": (
            "the temperature changed along with the path travelled, so that either may scale the response"
        ),
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_tired, _worn)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_levelling, _power)
    parameters = (Parameter("rate", 0.0, 1.0, "1/{input}", null=0.0, meaning="loss of amplitude a path"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.fatigue import fade

        output = own(inner(signal), signal)
        fade(output, signal.input, p.rate)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to a fall by a factor e³ in the record with the longest path."""
        longest = max(float(travelled(record.signal.input)[-1, 0]) for record in records)
        return (self.parameters[0].within(0.0, 3.0 / (longest or 1.0)),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        if reason := motionless(records):
            return reason
        # a loop that had settled is passed before it is scored, and shows no change with that path
        longest = max(float(np.ptp(travelled(record.signal.input)[record.scored])) for record in records)
        if longest < SHORTEST * input_span(records):
            return "the input passes through its range less than four times"
        return ""


def travelled(values: Array) -> Array:
    """Length of the path since the first sample, same shape."""
    path: Array = np.cumsum(np.abs(np.diff(values, axis=0, prepend=values[:1])), axis=0)
    return path

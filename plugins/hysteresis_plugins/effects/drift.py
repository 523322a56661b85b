"""Drift: the output runs away linearly in time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import longest, output_span, without_time


def _steady(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + hiding.strength * hiding.top * hiding.time / hiding.duration


def _faster(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + (0.15 + 0.2 * hiding.strength) * hiding.top * hiding.time / hiding.duration


def _levelling(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A warm-up: it levels off."""
    passed = hiding.time / hiding.duration
    return inner(u) + 0.7 * hiding.strength * hiding.top * -np.expm1(-3.0 * passed)


def _diffusive(inner: Response, u: Array, hiding: Hiding) -> Array:
    """With the square root of time."""
    return inner(u) + 0.7 * hiding.strength * hiding.top * np.sqrt(hiding.time / hiding.duration)


@dataclass(frozen=True)
class Drift(Effect):
    """The zero of the output runs away linearly in time, from the first sample of every record.

    y = x + rate (t - t_0), x the response: the drift of a sensor or a charge amplifier [1].

    [1] JCGM 200:2012, International vocabulary of metrology, 4.21 instrumental drift.
    """

    acts = "added"
    family = "change with time, path or temperature"
    affine = True
    linear = ("rate",)
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "temperature-sensitivity": "the temperature changed steadily with time, so that either may move the zero",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_steady, _faster)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_levelling, _diffusive)
    parameters = (Parameter("rate", -1.0, 1.0, "{output}/{time}", null=0.0, meaning="of the output's zero"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.curve_in_time import add

        if not signal.timed:
            return inner(signal)
        output = own(inner(signal), signal)
        add(output, signal.time - signal.time[0], p.rate)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to the range of the output in the longest record: more would have shown in that range."""
        fastest = (output_span(records) or 1.0) / longest(records)
        return (self.parameters[0].within(-fastest, fastest),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records)

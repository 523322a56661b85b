"""Late input: its channel was recorded later than the output's, so that the output runs ahead of what caused it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import longest_lag, middling_lag
from hysteresis_plugins.effects._ranges import FINEST, dominant_frequency, finest_step, unresolved

LONGEST = 0.25
"""Of the slowest record's period: a quarter of it ahead is a rate, as of a dashpot."""


def _shifted(inner: Response, u: Array, hiding: Hiding) -> Array:
    """By whole samples."""
    y, ahead = inner(u), max(1, round(longest_lag(hiding) / hiding.step))
    return np.concatenate([y[ahead:], np.full(ahead, y[-1])])


def _between(inner: Response, u: Array, hiding: Hiding) -> Array:
    return np.interp(hiding.time + middling_lag(hiding), hiding.time, inner(u))


def _slow_sensor(inner: Response, u: Array, hiding: Hiding) -> Array:
    """What drives is what a sensor of first order must have followed to show the input."""
    return inner(u + longest_lag(hiding) * np.gradient(u, hiding.step))


@dataclass(frozen=True)
class LateInput(Effect):
    """An input that was recorded later than the output, as behind a slower sensor, amplifier or filter of its own.

    y(t) = x(t + advance), x the response to the recorded input, constant after its last sample. Linear between samples.

    Every model and effect that does not know the absolute time commutes with it, so it acts on the output, as a
    `transport-delay` does, whose opposite it is: nothing that was measured rightly answers before it is asked.

    The box is logarithmic and ends above the null 0, at a fiftieth of a sampling step, which no longer differs from
    none. Its upper edge is a quarter of a period of the input.
    """

    acts = "output"
    family = "dynamics before the law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "viscous-damping": "a response that is a little ahead has a part that goes with its rate",
        "droop": "at one frequency droop is a lead",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_shifted, _between)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_slow_sensor,)
    parameters = (Parameter("advance", 1e-4, 1.0, "{time}", "log", null=0.0, meaning="by which the input is late"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.delay import delay

        output = inner(signal)
        if not signal.timed:
            return output
        # ahead in time is behind in time that runs backwards
        backwards = delay(-signal.time[::-1], np.ascontiguousarray(output[::-1]), p.advance)
        return np.ascontiguousarray(backwards[::-1])

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From a fiftieth of a sampling step to a quarter of the period of the slowest record's input."""
        period = 1.0 / min(dominant_frequency(record) for record in records)
        return (self.parameters[0].within(FINEST * finest_step(records), LONGEST * period),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)

"""Thresholds that grow with the frequency, as models of plays offer them: an effect inside the law."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import motionless, without_time

WIDEST = 0.9
"""Largest fall of a threshold, as a share of it, in the box."""
STEEPEST = 10.0
"""Largest rise of a threshold in the box: all but none of it is left at one cycle a unit of time."""
NARROWEST = 0.01
"""A threshold does not shrink below this share of it."""


def frequency(time: Array, u: Array) -> Array:
    """Cycles a unit of time: the path of the input over twice its range and the duration, (columns,); 1 where it does
    not move. u : (samples, columns)"""
    span, duration = np.ptp(u, axis=0), time[-1] - time[0]
    path = np.sum(np.abs(np.diff(u, axis=0)), axis=0)
    moving = span * duration > 0.0
    return np.where(moving, path / np.where(moving, 2.0 * span * duration, 1.0), 1.0)


def _logarithm(record: Record) -> float:
    return float(np.log(frequency(record.time, record.input[:, None])[0]))


def _stretched(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A law of plays with straight curves is stretched with its thresholds, input and output alike."""
    grown = 1.0 + 0.3 * hiding.strength * float(np.log(frequency(hiding.time, u[:, None])[0]))
    factor = max(grown, 0.3)
    return factor * inner(u / factor)


@dataclass(frozen=True)
class ThresholdRate(Effect):
    """Thresholds inside the law that grow with the logarithm of the frequency: r (1 + growth ln f).

    f is the record's number of cycles a unit of time, the path of its input over twice its range and its duration: r
    is the threshold at one cycle a unit of time. Domain walls and switching in ferroelectrics, whose coercive field
    is that of thermal activation, grow so [1]; over wider ranges Merz's law takes its place.

    [1] D. Viehland, Y.-H. Chen, J. Appl. Phys. 88 (2000) 6696.
    """

    acts = "law"
    family = "law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "input-lag": "both make the loop wider with the frequency",
        "transport-delay": "both make the loop wider with the frequency",
        "eddy-current": "both make the loop wider with the frequency",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_stretched,)
    parameters = (Parameter("growth", -0.1, 0.1, "1", null=0.0, meaning="of the thresholds with the log of frequency"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        return inner(signal)  # the model has applied it

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """What lowers no record's thresholds by more than nine tenths, and raises them by up to ten times themselves:
        what they are at one cycle a unit of time may be far from every record."""
        found = [_logarithm(record) for record in records]
        above, below = max(1.0, max(found)), max(1.0, -min(found))
        far = max(above, below)
        lower = -WIDEST / above if max(found) > 0.0 else -STEEPEST / far
        upper = WIDEST / below if min(found) < 0.0 else STEEPEST / far
        return (self.parameters[0].within(lower, upper),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        if reason := without_time(records) or motionless(records):
            return reason
        found = [_logarithm(record) for record in records if np.ptp(record.input) > 0.0]
        return "all records have one frequency" if max(found) - min(found) < np.log(1.2) else ""


OFFERS = {"threshold-rate": ThresholdRate()}


def rated(radii: Array, signal: Signal, p: Any) -> Array:
    """The thresholds, (plays, swarm), as they are at the signal's frequency where p has a growth."""
    rate = getattr(p, "threshold_rate", None)
    if rate is None or not signal.timed or not np.any(rate.growth):
        return radii
    grown = np.maximum(1.0 + rate.growth * np.log(frequency(signal.time, signal.input)), NARROWEST)
    return np.ascontiguousarray(radii * grown)

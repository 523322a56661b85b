"""What is done to a record before a model sees it; it travels with a fitted model, and predictions repeat it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.units import seconds_in
from hysteresis_bench.fit.json_values import number_of, value_of
from hysteresis_bench.fit.settling import MOST_REPEATS, is_closed, passed
from hysteresis_bench.signals import INDEX, Record

Values = TypeVar("Values", float, Array)

MOST_STEPS = 64
"""From one sample to the next; a file that asks for more is damaged."""

SHOWN = 8
"""Names that a sentence lists."""


@dataclass(frozen=True)
class Preparation:
    """What is done to a record before a model sees it.

    input_offset : subtracted from the input;  flip : changes its sign then
    skip : seconds at the start (samples, where time is an index) that are simulated and not scored
    settle : how often a closed loop is passed before it is scored; 0 where it is not
    steps : that are simulated from one sample to the next
    """

    input_offset: float = 0.0
    flip: bool = False
    skip: float = 0.0
    settle: int = 0
    steps: int = 1

    def __post_init__(self) -> None:
        """Raises ValueError for what cannot be done to a record."""
        limits = {
            f"input_offset = {self.input_offset:g} must be finite": np.isfinite(self.input_offset),
            f"skip = {self.skip:g} must be finite and at least 0": 0.0 <= self.skip < np.inf,
            f"settle = {self.settle} must lie from 0 to {MOST_REPEATS}": 0 <= self.settle <= MOST_REPEATS,
            f"steps = {self.steps} must lie from 1 to {MOST_STEPS}": 1 <= self.steps <= MOST_STEPS,
        }
        if wrong := [limit for limit, kept in limits.items() if not kept]:
            raise ValueError(f"preparation: {'; '.join(wrong)}.")

    def __call__(self, record: Record) -> Record:
        """The record as the model sees it; one that is no closed loop is passed once."""
        ready = replace(self.skipped(record), input=self.seen_input(record.input), steps=self.steps)
        return passed(ready, self.settle)

    def skipped(self, record: Record) -> Record:
        """The record as it is, its beginning turned into history."""
        return record.skip(seconds_in(record.units.get("time", "s"), self.skip)) if self.skip else record

    def seen_input(self, measured: Values) -> Values:
        """The input that the model sees for the actuator's."""
        seen: Values = measured - self.input_offset
        return -seen if self.flip else seen

    def measured_input(self, seen: Values) -> Values:
        """The actuator's input for the one that the model sees."""
        return (-seen if self.flip else seen) + self.input_offset

    def faults(self, records: Sequence[Record]) -> list[str]:
        """A sentence on every record of one sample, of which skipping leaves nothing to score, or of whose input an
        offset leaves nothing: a movement that is too small beside it is rounded away."""
        still = [
            record.name for record in records if np.ptp(record.input) and not np.ptp(self.seen_input(record.input))
        ]
        lost = [
            f"record {name}: beside an input offset of {self.input_offset:g} its input is constant." for name in still
        ]
        return lost + [
            f"record {record.name}: one sample is no signal; leave the record out."
            if record.time.size < 2
            else f"record {record.name}: skipping {self.skip:g} s leaves nothing of it: it lasts "
            f"{float(np.ptp(record.time)):g} {record.units.get('time', 's')}."
            for record in records
            if self.skipped(record).history > record.time.size - 2
        ]

    def words(self, records: Sequence[Record], time: str) -> list[str]:
        """What is done to these records because the fit did it, a sentence; and on those it cannot be done to.

        time : the unit of time
        """
        done = []
        if self.input_offset:
            done.append(f"{self.input_offset:g} is subtracted from the input")
        if self.flip:
            done.append("the sign of the input is changed")
        if self.skip:
            done.append(f"the first {self.skip:g} {INDEX if time == INDEX else 's'} are history and not scored")
        closed = [record for record in records if is_closed(record)]
        if self.settle and closed:
            done.append(f"closed loops are passed {self.settle} times before the pass that counts")
        if self.steps > 1:
            done.append(f"{self.steps} steps are simulated from one sample to the next")
        found = [f"As for the fit, {', '.join(done)}."] if done else []
        still = [record.name for record in records if not is_closed(record)] if self.settle else []
        if still:
            named = ", ".join(still[:SHOWN]) + (f" and {len(still) - SHOWN} more" if len(still) > SHOWN else "")
            found.append(f"No closed loop, so not repeated as the fit's loops were: {named}.")
        return found


AS_IT_IS = Preparation()


def preparation_of(content: Mapping[str, Any]) -> Preparation:
    """From model.json. Raises KeyError, TypeError or ValueError where it is wrong."""
    if unheard_of := content.keys() - {one.name for one in fields(Preparation)}:
        raise TypeError(f"preparation: {', '.join(unheard_of)}")
    offset, skip = number_of(content, "input_offset"), number_of(content, "skip")
    settle, steps = value_of(content, "settle", int), value_of(content, "steps", int)
    return Preparation(offset, value_of(content, "flip", bool), skip, settle, steps)

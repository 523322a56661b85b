"""Was the zero of the output set anew within records, each at a moment of its own?

Where the output moves, its own movement hides such a step from `data.faults.jumps`; in what a system leaves it shows.
One a record is looked for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.reading.in_turn import Own, own_of_each
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.signals import Record

MOVED = (
    "The zero of the output was set anew within records: {}. What comes after was moved back, also where it was held "
    "out. A sensor that slipped, or was zeroed?"
)

FEWEST = 10
"""Samples on either side of a step. In five made cases half and twice of it change nothing."""

HEARD = 5.0
"""Standard errors of a step's height, by the noise, from which there is one. In the same cases half of it finds one
more, of a quarter of the noise, and twice of it the same."""

AT, BY = " at", " by"
"""After a record's name, what is its own: the time of the step, and its height."""


def zeros_of_each(found: Found, held_out: Sequence[Record]) -> Own:
    """Time and height of the step of each record that has one; empty where steps do not come down to the noise, or
    nothing asks for any."""
    records, floor = (*found.thin.stack.records, *held_out), found.selection.floor

    def estimated(system: System, values: Array) -> Own:
        return {key: value for one in records for key, value in _step(one, system, values, floor).items()}

    return own_of_each(found, levelled, estimated, 2 * len(found.thin.stack.records))


def levelled(records: tuple[Record, ...], steps: Mapping[str, float]) -> tuple[Record, ...]:
    """Without the steps of their outputs; those without one as they are."""
    return tuple(
        replace(one, output=one.output - steps[one.name + BY] * (one.time >= steps[one.name + AT]))
        if one.output is not None and one.name + AT in steps
        else one
        for one in records
    )


def zeros_told(records: Sequence[Record], steps: Mapping[str, float]) -> str:
    """The note."""
    stepped = [record for record in records if record.name + AT in steps]
    return MOVED.format(
        listed([f"{one.name} by {steps[one.name + BY]:.3g} before time {steps[one.name + AT]:.6g}" for one in stepped])
    )


def _step(record: Record, system: System, values: Array, floor: float) -> Own:
    """The one that leaves least of what a system leaves, by two means; empty where it is not heard."""
    left = record.measured - system.respond(record, values[:, None])[record.scored, 0]
    before = np.arange(FEWEST, left.size - FEWEST + 1)
    if before.size == 0:
        return {}
    sums, after = np.cumsum(left), left.size - before
    heights = (sums[-1] - sums[before - 1]) / after - sums[before - 1] / before
    errors = floor * np.sqrt(1.0 / before + 1.0 / after)
    best = int(np.argmax(np.abs(heights) / errors))
    if abs(heights[best]) <= HEARD * errors[best]:
        return {}
    time = record.time[record.scored][before[best]]
    return {record.name + AT: float(time), record.name + BY: float(heights[best])}

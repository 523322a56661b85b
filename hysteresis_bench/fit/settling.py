"""Closed loops are repeated until they close: how often, and how far from closed a simulated loop still is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.signals import Record

CLOSED = 1e-3
"""A settled loop's last two passes differ by less than this fraction of the range of the output."""

FIRST_REPEATS, MOST_REPEATS = 2, 32
"""Passes before a loop is scored: doubled until it closes, or until the fit says that it does not."""


def open_loops(records: Sequence[Record]) -> list[str]:
    """A sentence on every record that is no closed loop, so that it cannot be repeated."""
    return [
        f"record {record.name} is not a closed loop: its input begins at {record.input[0]:g} and ends at "
        f"{record.input[-1]:g}. Leave --settle out, or cut the record to whole periods."
        for record in records
        if not is_closed(record)
    ]


def is_closed(record: Record) -> bool:
    """Whether the input ends where it began, to within two of its steps."""
    return bool(abs(record.input[-1] - record.input[0]) <= 2 * float(np.max(np.abs(np.diff(record.input)))))


def passed(record: Record, repeats: int, rest: float = 0.0) -> Record:
    """A closed loop preceded by `repeats` of itself; what is none stays as it is.

    A device is at rest without input, not at the end of a loop where a record begins: what lies outside the loop stays
    as it was there, and shifts a law that feeds its output back. Where the loop passes that input and begins
    elsewhere, the way from there, as long as a period, is the first of these passes.

    rest : the input of a device at rest
    """
    if not repeats or not is_closed(record):
        return record
    ready, u = record.settled(repeats), record.input
    begins = abs(float(u[0]) - rest) <= 2.0 * float(np.max(np.abs(np.diff(u))))
    if begins or not float(u.min()) < rest < float(u.max()):
        return ready
    way = np.linspace(rest, u[0], u.size, endpoint=False)
    return replace(ready, input=np.concatenate([way, ready.input[way.size :]]))


def gap_after(system: System, records: Sequence[Record], values: Array, *, repeats: int) -> float:
    """How far the last two passes of the worst loop differ, as a fraction of the range of its output.

    values : (dimension,), in units;  records : as of `passed`; those that are no closed loop do not count
    """
    gaps = []
    for record in filter(is_closed, records):
        simulated = system.respond(record, values[:, None])[:, 0]
        period = record.time.size // (repeats + 1)
        last, before = simulated[-period:], simulated[-2 * period : -period]
        gaps.append(float(np.max(np.abs(last - before)) / (np.ptp(record.measured) or 1.0)))
    return max(gaps, default=0.0)


def not_closed(gap: float, repeats: int) -> list[str]:
    """The sentence on a loop that does not close, or nothing."""
    if gap < CLOSED:
        return []
    return [
        f"After {repeats} passes the simulated loop still moves by {100 * gap:.1f} % of its range a pass: "
        f"the model does not close this loop."
    ]

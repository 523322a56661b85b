"""A hum that was sampled too coarsely is known by its alias: of records sampled otherwise it is another one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.compose import System
from hysteresis_bench.data.units import rounded
from hysteresis_bench.signals import Record

OTHERWISE = 0.05
"""Share of a step by which steps differ that are not the same. Rates of sampling are chosen, and differ by more or not
at all: half or twice of it changes what is told of steps that are 2.5 to 10 % off."""

FAMILY = "added disturbance"


def step_of(record: Record) -> float:
    """Median step from sample to sample, unit of time."""
    return float(np.median(np.diff(record.time))) if record.time.size > 1 else 0.0


def steps(records: Sequence[Record]) -> list[float]:
    """The shortest and the longest of the records' steps; nothing where time is only an index."""
    own = [step_of(record) for record in records if record.timed and record.time.size > 1]
    return [min(own), max(own)] if own else []


def alias_told(system: System, fitted: Any, record: Record) -> str:
    """A sentence where what was fitted as a hum may be another one in a record; "" where it may not.

    fitted : as of `steps`, from a file; where the two differ, an alias would not have followed both
    """
    names = [name for name, effect in system.effects if effect.family == FAMILY]
    match fitted:
        case [int() | float() as least, int() | float() as most] if 0.0 < least <= most <= (1.0 + OTHERWISE) * least:
            ratio = step_of(record) / least
        case _:
            return ""
    # of whole multiples the samples are among those of the shorter step, where hum and alias are the same
    if not names or not record.timed or abs(ratio - max(round(ratio), 1)) <= OTHERWISE:
        return ""
    return (
        f"record {record.name}: its samples are {rounded(ratio)} times as far apart as those of the fitted records. "
        f"What is {names[0]} there may be the alias of a faster one, which is another one here."
    )

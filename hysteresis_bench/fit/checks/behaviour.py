"""Does a model, do its effects, keep what they promise? Asked of a few points before numbers are believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.errors import told
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

PLACES = (0.25, 0.5, 0.75)
"""Where in the box they are asked."""


class BrokenPromise(Exception):
    """A model or an effect does what its contract forbids."""


def broken_promises(system: System, records: Sequence[Record]) -> list[str]:
    """What a system's model and effects do that contracts.py forbids, a sentence each; empty when nothing is.

    Asked on the first record: shapes, finite numbers, arguments left as they are, null values that change nothing.
    """
    whole = replace(system, fixed={})
    space = Space(whole.box(records))
    values = space.from_unit(np.tile(PLACES, (space.dimension, 1)))
    record = records[0]
    try:
        if fault := _fault(whole, record, values):
            return [fault]
        return [fault for index in range(len(whole.effects)) if (fault := _null_fault(whole, index, record, values))]
    except Exception as error:
        return [f"simulating {_named(whole)} ends with {told(error)}."]


def _fault(system: System, record: Record, values: Array) -> str:
    given = values.copy()
    simulated = system.simulate(record.signal, given)
    expected = (record.signal.time.size, values.shape[1])
    if not isinstance(simulated, np.ndarray) or simulated.shape != expected:
        return f"{_named(system)} must answer an array (samples, swarm) = {expected}, not {np.shape(simulated)}."
    if not np.array_equal(given, values, equal_nan=True):
        return f"{_named(system)} writes into the parameters that it is given."
    if not np.isfinite(simulated).any():
        return f"{_named(system)} answers no finite number at any of {len(PLACES)} points of its box."
    return ""


def _null_fault(system: System, index: int, record: Record, values: Array) -> str:
    """Of the effect at that place among the effects."""
    name, effect = system.effects[index]
    nulls = {f"{name}.{parameter.name}": parameter.null for parameter in effect.parameters}
    off = {key: null for key, null in nulls.items() if null is not None}
    if not off:
        return ""
    names = [parameter.name for parameter in system.parameters]
    at_null = values.copy()
    for key, null in off.items():
        at_null[names.index(key)] = null
    without = replace(system, effects=system.effects[:index] + system.effects[index + 1 :])
    kept = [row for row, key in enumerate(names) if key not in nulls]
    bare = without.simulate(record.signal, values[kept])
    switched_off = system.simulate(record.signal, at_null)
    if np.array_equal(switched_off, bare, equal_nan=True):
        return ""
    where = ", ".join(f"{key} = {null:g}" for key, null in off.items())
    most = np.nanmax(np.abs(switched_off - bare))
    return f"effect {name} changes the output by up to {most:.3g} at its null value ({where}): it must not."


def _named(system: System) -> str:
    around = "".join(f" with {name}" for name, _ in system.effects)
    return f"the model {type(system.model).__name__}{around}"

"""Records in the units that a law or an effect with constants of its own asks for, such as a rod with a mass in kg."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.data.units import in_units, same_unit
from hysteresis_bench.signals import UNITLESS, Dataset, Record

Declared: TypeAlias = Model | Effect | type[Effect]

NONE = "1"
"""Of a column whose header states no unit."""


def in_wanted_units(dataset: Dataset, parts: Iterable[Declared], whose: str) -> Dataset:
    """The records in the units that parts of a system want, told in `notes`; a column without one is taken as in it.

    whose : units are wanted, such as "free-energy-gma's"
    Raises UserError naming every column whose unit does not convert, with both units.
    """
    wanted = {column: unit for part in parts for column, unit in _wanted(part, dataset.records).items()}
    if not wanted:
        return dataset
    asked = dataset.map(lambda record: replace(record, units=_stated(record, wanted)))
    ready = in_units(asked, wanted, "the records", whose)
    kept = {record.name: {**UNITLESS, **record.units} for record in dataset.records}  # of columns that are in any unit
    return ready.map(lambda record: replace(record, units={**kept[record.name], **record.units}))


def unlike_wanted(part: Declared, records: Sequence[Record]) -> str:
    """Why a law or an effect cannot take the records, where a column is in another unit than it wants; else ""."""
    for column, unit in _wanted(part, records).items():
        for record in records:
            if (own := _stated(record, [column]).get(column)) is not None and not same_unit(own, unit):
                return f"it takes the {column} in {unit}, and the records have it in {own}"
    return ""


def _wanted(part: Declared, records: Sequence[Record]) -> Mapping[str, str]:
    """A time that is only an index is in no unit."""
    timed = all(record.timed for record in records)
    return {column: unit for column, unit in part.wants.items() if timed or column != "time"}


def _stated(record: Record, columns: Collection[str]) -> Mapping[str, str]:
    return {column: unit for column, unit in record.units.items() if unit != NONE and column in columns}

"""Records in parts: of one that is faulty in places, what lies between them.

Every part begins where the record does, so that a model has its memory; what comes before it is simulated and not
scored. The first part keeps the record's name.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from hysteresis_bench.signals import Dataset, Record

FEWEST_SAMPLES = 40
"""Samples of a part that is fitted; a shorter one is left out."""


def parts(record: Record, stretches: Sequence[tuple[int, int]]) -> tuple[Record, ...]:
    """stretches : first sample of each, and the one behind; the record itself where all are short"""
    kept = [(low, high) for low, high in stretches if high - low >= FEWEST_SAMPLES]
    if not kept:
        return (record,)
    names = [record.name, *(f"{record.name} from {record.time[low]:.12g}" for low, _ in kept[1:])]
    each = zip(kept, names, strict=True)
    return tuple(replace(record.take(slice(0, high), name), history=low) for (low, high), name in each)


def parted(dataset: Dataset, look: Callable[[Record], tuple[Sequence[Record], str]]) -> Dataset:
    """The data set with every record in its parts, and notes.

    look : a record's parts, and what is said of it; nothing is said of one that has none
    """
    records, notes, held_out = list[Record](), list(dataset.notes), list(dataset.held_out_names)
    for record in dataset.records:
        found, said = look(record)
        records += found
        new = [part.name for part in found if part.name != record.name]
        held_out += new if record.name in dataset.held_out_names else []
        if said:
            after = f" as {' and '.join(new)}" if new else ""
            notes.append(f"{said}{after}.")
    return replace(dataset, records=tuple(records), notes=tuple(notes), held_out_names=tuple(held_out))

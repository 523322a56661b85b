"""What is said about the records that are fitted: where they jump, and what the law says, with effects around it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import fields, is_dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.contracts import Model
from hysteresis_bench.fit.checks.faulty_records import jumps_told
from hysteresis_bench.signals import Record


def advice_with(model: Model, effects: Collection[str], records: Sequence[Record]) -> tuple[str, ...]:
    """Jumps of the records, and the model's advice on them; where an effect has the offset, as if they had none.

    effects : by name
    """
    if not {*registry.OFFSETS}.isdisjoint(effects):
        records = [_without_offset(record) for record in records]
    return (*filter(None, map(jumps_told, records)), *model.advice(records))


def more_parts(model: Model) -> list[str]:
    """A sentence, where settings say how many parts the law is divided into, or steps are made, and may be doubled."""
    assert is_dataclass(model)
    settings = {one.name: getattr(model, one.name) for one in fields(model)}
    asked = []
    for name, count in settings.items():
        with suppress(ValueError):
            if type(count) is int and replace(model, **{name: 2 * count}):
                asked.append(f"--set {name}={2 * count}")
    told = f"This law is as fine as its settings say: `{' '.join(asked)}` may follow more closely what is left."
    return [told] if asked else []


def _without_offset(record: Record) -> Record:
    """Moved along the output, so that the middle of its loop lies on the line through 0 that spans its ranges."""
    if record.output is None or not (span := float(np.ptp(record.input[record.scored]))):
        return record
    driven, found = record.input[record.scored], record.measured
    slope = float(np.ptp(found)) / span
    centre = 0.5 * (found.min() + found.max() - slope * (driven.min() + driven.max()))
    return replace(record, output=record.output - centre)

"""Records of fewer samples than the other commands ask for, told before one of them refuses them."""

from __future__ import annotations

from collections.abc import Sequence

from hysteresis_bench.signals import Record

NEEDED = 40
"""Scored samples that `diagnose` and `compare` need of a record; a test holds it to theirs."""


def few_told(records: Sequence[Record]) -> str:
    """A sentence on the records of fewer scored samples than are needed; empty where all have enough."""
    few = {record.name: record.time[record.scored].size for record in records}
    few = {name: samples for name, samples in few.items() if samples < NEEDED}
    if not few:
        return ""
    name, samples = next(iter(few.items()))
    which = f"{name}: {samples} samples are too few"
    if len(few) > 1:
        which = f"{name} and {len(few) - 1} more: {min(few.values())} to {max(few.values())} samples are too few"
    return (
        f"{which}: `diagnose` and `compare` need {NEEDED} of a record, and `fit` needs as many in all as its model has "
        f"parameters. Take more samples a cycle, or a longer record."
    )

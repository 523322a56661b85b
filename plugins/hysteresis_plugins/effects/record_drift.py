"""Record drift: one straight line in time a record, where every record drifts in its own way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import without_time


@dataclass(frozen=True)
class RecordDrift(Effect):
    """One straight line in time a record: a nuisance, estimated on every record that has an output as the slope of
    measured minus simulated over its scored samples (the least-squares estimate).

    The line is zero in the middle of what is scored: the mean is left to `record-offset`. A record without an
    output is given none, as its drift is not known. What all records share is `drift`.
    """

    acts = "added"
    family = "change with time, path or temperature"
    nuisance = True
    estimates = 1
    affine = True
    parameters: ClassVar[tuple[Parameter, ...]] = ()

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        return inner(signal)

    def adjust(self, simulated: Array, record: Record, p: Any = None) -> Array:
        if record.output is None or not record.timed:
            return simulated
        scored = record.time[record.scored]
        since = scored - np.mean(scored)
        left = record.measured[:, None] - simulated[record.scored]
        slope: Array = since @ left / (since @ since or 1.0)  # a single sample has no slope
        line: Array = (record.time - np.mean(scored))[:, None] * slope
        return simulated + line

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records)

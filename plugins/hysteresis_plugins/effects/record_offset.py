"""Record offset: one constant a record, for records taken on different days."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal


@dataclass(frozen=True)
class RecordOffset(Effect):
    """One constant a record: a nuisance, estimated on every record that has an output as the mean of
    measured minus simulated over its scored samples (the least-squares estimate).

    `default` is what a record without an output is given; the median of a fit's records.
    """

    acts = "added"
    family = "change with time, path or temperature"
    nuisance = True
    estimates = 1
    affine = True
    parameters: ClassVar[tuple[Parameter, ...]] = ()

    default: float = 0.0

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        return inner(signal)

    def adjust(self, simulated: Array, record: Record, p: Any = None) -> Array:
        from hysteresis_bench.kernels.effects.offset import raised

        return raised(simulated, self.offset(simulated, record, None))

    def offset(self, simulated: Array, record: Record, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.offset import missing

        if record.output is None:
            return np.full(simulated.shape[1], self.default)
        measured = record.measured
        return missing(simulated, record.history, float(measured.sum() / measured.size))

    def remembered(self, offsets: Sequence[float]) -> RecordOffset:
        return replace(self, default=float(np.median(offsets)))

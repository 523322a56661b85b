"""How far a simulation is from the measurement: RMSE, relative RMS, largest error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.signals import Record


@dataclass(frozen=True)
class Accuracy:
    """rmse : in units of the output. relative_rms, max_error : fractions of max |y - offset| measured."""

    rmse: float
    relative_rms: float
    max_error: float

    def as_dict(self) -> dict[str, float]:
        return asdict(self)


def accuracy(system: System, records: Sequence[Record], values: Array) -> Accuracy:
    """Over the scored samples of all records together; values : (dimension,), in units."""
    column = values.reshape(-1, 1)
    squares, samples, scale, largest = 0.0, 0, 0.0, 0.0
    for record in records:
        error = system.respond(record, column)[record.scored, 0] - record.measured
        offset = float(sum(offset[0] for offset in system.offsets(record, column)))
        squares += float(error @ error)
        samples += error.size
        scale = max(scale, float(np.max(np.abs(record.measured - offset))))
        largest = max(largest, float(np.max(np.abs(error))))
    rmse = float(np.sqrt(squares / samples))
    scale = scale or 1.0
    return Accuracy(rmse, rmse / scale, largest / scale)

"""A simulation beside the measurement: RMSE, relative RMS, largest error, and the table sample by sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.signals import Dataset, Record


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


def constant_error(system: System, records: Sequence[Record], values: Array) -> float:
    """RMS of the constants by which the records are missed, 0 without records;  values : (dimension,), in units."""
    parts = zip(records, simulated(system, records, values), strict=True)
    squares = [(own.size, float(np.mean(own - record.measured)) ** 2) for record, own in parts]
    return float(np.sqrt(sum(n * square for n, square in squares) / max(sum(n for n, _ in squares), 1)))


def error_table(system: System, values: Array, dataset: Dataset) -> pd.DataFrame:
    """record, role (fitted or held-out), and the accuracy of each;  values : (dimension,), in units."""
    rows = []
    for record in dataset.records:
        rows.append(
            {"record": record.name, "role": dataset.role(record), **accuracy(system, [record], values).as_dict()}
        )
    return pd.DataFrame(rows)


def simulated(system: System, records: Sequence[Record], values: Array) -> list[Array]:
    """The response to every record, (scored samples,) each; values : (dimension,), in units."""
    return [system.respond(record, values.reshape(-1, 1))[record.scored, 0] for record in records]


def response_table(dataset: Dataset, responses: Mapping[str, Sequence[Array]]) -> pd.DataFrame:
    """record, role (fitted or held-out), time, input, output, and a column a response; the scored samples.

    responses : by column's name, (scored samples,) for every record of the data set
    """
    parts = []
    for index, record in enumerate(dataset.records):
        columns = {
            "record": record.name,
            "role": dataset.role(record),
            "time": record.time[record.scored],
            "input": record.input[record.scored],
            "output": record.measured,
        }
        parts.append(pd.DataFrame({**columns, **{name: each[index] for name, each in responses.items()}}))
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame()

"""A file with a wanted output over time, for a feed-forward."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from hysteresis_bench.data.data_files import read_columns, time_faults
from hysteresis_bench.data.layout import AS_THEY_SAY, Layout
from hysteresis_bench.data.units import in_units
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record

REFERENCE = "reference"
"""What the column of the wanted output may be called, beside `output`."""


def read_trajectory(path: Path, units: Mapping[str, str], layout: Layout = AS_THEY_SAY) -> Dataset:
    """Time and wanted output of a CSV with the columns `time` and `output` (or `reference`), in a model's units.

    The wanted output stands in a record's `input` as in its `output`, for what asks whether a loop is closed.
    layout : what the file does not say itself
    Raises UserError naming file, row and column.
    """
    timed = ["time"] if layout.rate is None else []
    other = layout.output is None and REFERENCE in read_columns(path, timed, layout).numbers
    name = REFERENCE if other else "output"
    columns = read_columns(path, [*timed, name], layout)
    time, wanted = columns.numbers["time"], columns.numbers[name]
    if faults := time_faults(time, columns.lines) if time.size > 1 else ["needs at least 2 samples."]:
        raise UserError(str(path), faults)
    stated = {"time": columns.units.get("time"), "output": columns.units.get(name)}
    record = Record(time, wanted, wanted, path.stem, {key: unit for key, unit in stated.items() if unit is not None})
    known = in_units(Dataset((record,)), {key: units[key] for key in stated}, str(path), "the model's")
    return known.map(lambda one: Record(one.time, one.output, one.output, one.name, units))

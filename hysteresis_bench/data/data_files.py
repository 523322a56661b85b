"""Data CSV in and out: header with time, input, output, optional run and further columns; units in brackets.

Faults name file, row and column. Rows are counted as a text editor counts lines: the header is line 1.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.csv_files import read_cells, unguarded, write_table
from hysteresis_bench.data.units import in_units
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.signals import UNITLESS, Dataset, Record, joined

HEADER = re.compile(r"(?P<name>[^\[\]]+)(?:\[(?P<unit>[^\[\]]*)\])?")
HISTORY = "history"
"""A column of 1 for leading samples that are not scored, 0 for the others."""
LONGEST = 200
"""Characters of a column's name."""
KEEP_FAULTS = 8
"""Faults told of one file; a broken column has thousands."""
LARGEST, SHORTEST = 1e100, 1e-100
"""Largest number, and shortest step of time or range of an input, that can be squared and summed."""


@dataclass(frozen=True, eq=False)
class Columns:
    """A CSV with some columns of finite numbers.

    lines : (samples,) where each sample stands in the file;  units : the ones that the header states
    """

    lines: Array
    numbers: Mapping[str, Array]
    units: Mapping[str, str]
    runs: Sequence[str] | None


def read_data(
    files: Sequence[Path | str], output_needed: bool = True, units: Mapping[str, str] | None = None
) -> Dataset:
    """One or more CSV files as a data set, all of it fitted, all in the same units; `notes` tell what was converted.

    units : a model's, which the records are converted into; by default those of the first record that states one
    Raises UserError naming file, row, column.
    """
    read = [(str(file), _records(Path(file), output_needed)) for file in files]
    stated = {name: unit for _, one in reversed(read) for name, unit in one.records[0].units.items()}
    wanted, whose = (units, "the model's") if units else ({**UNITLESS, **stated}, "the other records'")
    try:
        return joined(*(in_units(dataset, wanted, file, whose) for file, dataset in read))
    except ValueError as error:
        raise UserError(", ".join(map(str, files)), f"{error}.") from None


def read_columns(path: Path, required: Sequence[str]) -> Columns:
    """The numeric columns of a CSV, the required ones among them. Raises UserError naming file, row, column."""
    frame, units = _table(path)
    missing = [name for name in required if name not in frame.columns]
    if missing:
        raise UserError(str(path), [f'no column "{name}". {nearest(name, frame.columns[:50])}' for name in missing])
    numbers, faults = {}, []
    for name in frame.columns.drop("run", errors="ignore"):
        values = np.array([_number(cell) for cell in frame[name]])
        good = np.abs(values) <= LARGEST  # False for what is no number, too
        if name in required or np.mean(good) > 0.5:  # a further column of text, such as a remark, is left out
            numbers[name] = values
            if not np.all(good):
                faults.append(_number_fault(frame[name], np.nonzero(~good)[0]))
    if faults:
        raise UserError(str(path), faults[:KEEP_FAULTS])
    runs = [unguarded(run) for run in frame["run"]] if "run" in frame else None
    return Columns(frame.index.to_numpy(), numbers, units, runs)


def write_csv(path: Path, dataset: Dataset) -> None:
    """Write records as this module reads them; a run column only where there are several.

    The column `history` is 1 for leading samples that are not scored; it is written where a record has some.
    """
    parts, with_history = [], any(record.history for record in dataset.records)
    for record in dataset.records:
        columns = {"time": record.time, "input": record.input, "output": record.output, **record.columns}
        part = pd.DataFrame({_label(name, record.units): values for name, values in columns.items()})
        if with_history:
            part[HISTORY] = (np.arange(len(part)) < record.history).astype(int)
        if len(dataset.records) > 1:
            part["run"] = record.name
        parts.append(part)
    write_table(path, pd.concat(parts))


def time_faults(time: Array, lines: Array) -> list[str]:
    """A sentence on the first step of time that cannot be worked with; lines : (samples,) of the file."""
    step = np.diff(time)
    bad = np.nonzero(step < SHORTEST)[0]
    if not bad.size:
        return []
    first = bad[0]
    where = f'row {lines[first + 1]}, column "time":'
    if step[first] > 0:
        return [f"{where} a step of {step[first]:g} is too short to work with."]
    return [
        f"{where} {time[first + 1]:g} does not come after {time[first]:g}; time must strictly increase within a record."
    ]


def _records(path: Path, output_needed: bool) -> Dataset:
    """A record, or one a run where there is a run column; their units are the stated ones alone."""
    columns = read_columns(path, ["time", "input", *(["output"] if output_needed else [])])
    names = columns.runs or [""] * columns.lines.size
    samples: dict[str, list[int]] = {}
    for sample, run in enumerate(names):
        samples.setdefault(run, []).append(sample)
    faults: list[str] = []
    records = []
    for run, rows in samples.items():
        name = path.stem if columns.runs is None else f"{path.stem}:{run}"
        numbers = {column: values[rows] for column, values in columns.numbers.items()}
        marks = numbers.pop(HISTORY, np.zeros(len(rows)))
        history = int(np.count_nonzero(marks))
        faults += _record_faults(name, numbers, columns.lines[rows], to_fit=output_needed)
        if not np.array_equal(marks, np.arange(len(rows)) < history) or history == len(rows):
            faults.append(f'record {name}, column "{HISTORY}": 1 for leading samples, 0 for what is scored.')
        if not faults:
            measured = (numbers.pop("time"), numbers.pop("input"), numbers.pop("output", None))
            records.append(Record(*measured, name=name, units=columns.units, columns=numbers, history=history))
    if faults:
        raise UserError(str(path), faults[:KEEP_FAULTS])
    return Dataset(tuple(records))


def _label(name: str, units: Mapping[str, str]) -> str:
    unit = units.get(name, "1")
    return name if unit == "1" else f"{name} [{unit}]"


def _table(path: Path) -> tuple[pd.DataFrame, dict[str, str]]:
    """The cells as text, indexed by line number, with plain column names; and the units in brackets."""
    cells = read_cells(path)
    header, frame = cells.iloc[0], cells.iloc[1:]
    units, names = {}, []
    for number, column in enumerate(header, start=1):
        if len(column) > LONGEST:
            found = f"column {number} has a name of {len(column)} characters; is the first line a header?"
            raise UserError(str(path), found)
        match = HEADER.fullmatch(unguarded(column.strip()))
        names.append(match["name"].strip().lower() if match else column)
        if match and match["unit"] and match["unit"].strip():
            units[names[-1]] = match["unit"].strip()
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise UserError(str(path), [f'two columns are called "{name}".' for name in doubled[:KEEP_FAULTS]])
    frame.columns = pd.Index(names)
    filled = (frame != "").any(axis=1)
    if not filled.any():
        raise UserError(str(path), "has a header but no samples.")
    return frame[filled], units


def _number(cell: str) -> float:
    """The number in a cell, NaN where there is none."""
    try:
        return math.nan if "_" in cell else float(cell)  # Python reads 1_0 as 10
    except ValueError:
        return math.nan


def _number_fault(cells: pd.Series, bad: Array) -> str:
    text = cells.iloc[bad[0]].strip()
    shown = f'"{text[:40]}"' if text else "empty"
    too_large = math.isfinite(_number(text))
    why = f"is too large to work with, beyond {LARGEST:g}" if too_large else "is not a finite number"
    more = f" ({bad.size} such values in this column)" if bad.size > 1 else ""
    return f'row {cells.index[bad[0]]}, column "{cells.name}": {shown} {why}{more}.'


def _record_faults(name: str, numbers: Mapping[str, Array], lines: Array, to_fit: bool) -> list[str]:
    if lines.size < 2:
        return [f"record {name} has {lines.size} sample; at least 2 are needed."]
    faults = time_faults(numbers["time"], lines)
    if to_fit and np.ptp(numbers["input"]) < SHORTEST:
        faults.append(
            f'record {name}, column "input": constant at {numbers["input"][0]:g}; nothing can be identified '
            f"from an input that does not move."
        )
    return faults

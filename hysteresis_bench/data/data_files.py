"""Data CSV in and out: header with time, input, output, optional run and further columns; units in brackets.

Faults name file, row and column. Rows are counted as a text editor counts lines: the header is line 1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.data.faults.time_holes import time_holes, time_holes_told
from hysteresis_bench.data.layout import AS_THEY_SAY, Layout
from hysteresis_bench.data.readers.columns import KEEP_FAULTS
from hysteresis_bench.data.readers.files import read_sheets
from hysteresis_bench.data.readers.samples import HISTORY, Columns, numbers_of
from hysteresis_bench.data.readers.samples import LARGEST as LARGEST
from hysteresis_bench.data.readers.sheet import Sheet, together
from hysteresis_bench.data.units import in_units, is_no_duration
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import INDEX, UNITLESS, Dataset, Record, joined

SHORTEST = 1e-70
"""Shortest step of time, or range of an input or output, that can be worked with: fourth powers of it, which tests
take, must not become 0."""

MOVING = ("input", "output")
"""Columns that must move by enough."""


def read_data(
    files: Sequence[Path | str],
    output_needed: bool = True,
    units: Mapping[str, str] | None = None,
    layout: Layout = AS_THEY_SAY,
) -> Dataset:
    """One or more data files as a data set, all of it fitted, all in the same units; `notes` tell what was converted.

    units : a model's, which the records are converted into; by default those of the first record that states one
    layout : what the files do not say themselves
    Raises UserError naming file, row, column.
    """
    for name in map(str, files):
        if (shown := name.encode("utf-8", "replace").decode()) != name:  # what is made of it is called after it
            raise UserError(shown, "the name of the file holds bytes that are no letters; give it another name.")
    read = [(str(file), _records(Path(file), output_needed, layout)) for file in files]
    stated = {
        name: unit
        for _, one in reversed(read)
        for record in reversed(one.records)
        for name, unit in record.units.items()
    }
    wanted, whose = (units, "the model's") if units else ({**UNITLESS, **stated}, "the other records'")
    alike = [in_units(dataset, wanted, file, whose) for file, dataset in read]
    try:
        return joined(*alike)
    except UserError as error:
        raise UserError(", ".join(map(str, files)), error.faults) from None


def read_columns(path: Path, required: Sequence[str], layout: Layout = AS_THEY_SAY) -> Columns:
    """The numeric columns of a file's first sheet that has the required ones. Raises UserError naming file, row,
    column."""
    return _columns(path, required, layout)[0]


def _columns(path: Path, required: Sequence[str], layout: Layout) -> list[Columns]:
    """Those of every sheet that has the required ones."""
    sheets = read_sheets(path, layout)
    found, refused = _readable(path, sheets, layout, required)
    if not found and len(sheets) > 1 and not any(_is_broken(error) for _, error in refused):
        found, refused = _readable(path, [together(sheets)], layout, required)  # the columns may lie apart
    if not found or (refused and layout.sheet is None and any(_is_broken(error) for _, error in refused)):
        raise refused[0][1] if not found else next(error for _, error in refused if _is_broken(error))
    if refused:
        names = ", ".join(f'"{name}"' for name, _ in refused)
        told = f"{path}: {names} left out: the columns that are needed are not there."
        found[0] = replace(found[0], notes=(*found[0].notes, told))
    return found


def _readable(
    path: Path, sheets: Sequence[Sheet], layout: Layout, required: Sequence[str]
) -> tuple[list[Columns], list[tuple[str, UserError]]]:
    """Those sheets that can be read, and why the others cannot, with their names."""
    found, refused = [], []
    for sheet in sheets:
        where = f"{path}, {sheet.name}" if sheet.name and len(sheets) > 1 else str(path)
        try:
            found.append(numbers_of(where, sheet, layout, required))
        except UserError as error:
            refused.append((sheet.name, error))
    return found, refused


def _is_broken(error: UserError) -> bool:
    """Whether a sheet has the columns, but what is in them is at fault."""
    return not any("no column" in fault or "no samples" in fault for fault in error.faults)


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
    told = f"{where} {time[first + 1]:g} does not come after {time[first]:g}; "
    told += "time must strictly increase within a record."
    if step[first] == 0:
        return [f"{told} Where the clock is too coarse, give --rate HZ."]
    return [f"{told} Where another record begins, tell them apart by a column run, or an empty line between them."]


def _records(path: Path, output_needed: bool, layout: Layout) -> Dataset:
    """A record, or one a sheet and a run where there are several; their units are the stated ones alone."""
    required = ["time", "input", *(["output"] if output_needed else [])]
    if layout.rate is not None:
        required.remove("time")
    sheets = _columns(path, required, layout)
    faults: list[str] = []
    records, rows, holes_told = [], [], []
    for columns in sheets:
        if is_no_duration(unit := columns.units.get("time", "s")):
            faults.append(f'column "time" is in {unit}, which is no unit of time; is it the right column?')
        names = columns.runs or [""] * columns.lines.size
        samples: dict[str, list[int]] = {}
        for sample, run in enumerate(names):
            samples.setdefault(run, []).append(sample)
        stem = f"{path.stem}:{columns.sheet}" if len(sheets) > 1 and columns.sheet else path.stem
        for run, where in samples.items():
            name = stem if columns.runs is None else f"{stem}:{run}"
            numbers = {column: values[where] for column, values in columns.numbers.items()}
            marks = numbers.pop(HISTORY, np.zeros(len(where)))
            history = int(np.count_nonzero(marks))
            faults += _record_faults(name, numbers, columns.lines[where], to_fit=output_needed)
            if not np.array_equal(marks, np.arange(len(where)) < history) or history == len(where):
                faults.append(f'record {name}, column "{HISTORY}": 1 for leading samples, 0 for what is scored.')
            if not faults:
                measured = (numbers.pop("time"), numbers.pop("input"), numbers.pop("output", None))
                records.append(Record(*measured, name=name, units=columns.units, columns=numbers, history=history))
                holes = time_holes(records[-1])
                holes = holes[~columns.behind_gap[where][holes + 1]]  # that gap is told already
                rows.append(_understood(records[-1], columns, holes.size))
                if told := time_holes_told(records[-1], holes, columns.lines[where]):
                    holes_told.append(f"{path}: {told}")
    if faults:
        raise UserError(str(path), faults[:KEEP_FAULTS])
    notes = [*(note for columns in sheets for note in columns.notes), *holes_told]
    return Dataset(tuple(records), notes=tuple(notes), understood=tuple(rows))


def _understood(record: Record, columns: Columns, holes: int) -> Mapping[str, str]:
    """A row of the table that tells how a record was read; holes : in its time, which are gaps, too."""
    steps = np.diff(record.time)
    rate = 1.0 / float(np.median(steps)) if steps.size and np.median(steps) > 0 else math.nan
    unit = columns.units.get("time", "s")
    per = {"s": "Hz", "ms": "kHz", "us": "MHz", "µs": "MHz", INDEX: "a sample"}.get(unit, f"1/{unit}")
    span = f"{float(record.time[-1] - record.time[0]):.4g} {unit}" if record.time.size else ""
    first = {"record": record.name, "samples": str(record.time.size), "duration": span, "rate": f"{rate:.4g} {per}"}
    return {**first, **columns.understood, "gaps": str(int(columns.understood["gaps"]) + holes)}


def _label(name: str, units: Mapping[str, str]) -> str:
    unit = units.get(name, "1")
    return name if unit == "1" else f"{name} [{unit}]"


def _record_faults(name: str, numbers: Mapping[str, Array], lines: Array, to_fit: bool) -> list[str]:
    if lines.size < 2:
        return [f"record {name} has {lines.size} sample; at least 2 are needed."]
    faults = time_faults(numbers["time"], lines)
    if not to_fit:
        return faults
    if not np.ptp(numbers["input"]) > 0.0:
        faults.append(
            f'record {name}, column "input": constant at {numbers["input"][0]:g}; nothing can be identified '
            f"from an input that does not move."
        )
    faults += [f'record {name}, column "{role}": {small}' for role in MOVING if (small := too_small(numbers[role]))]
    return faults


def too_small(values: Array) -> str:
    """A sentence on values that move by too little to be worked with; empty where they move by more, or not at all."""
    moved = float(np.ptp(values)) if values.size else 0.0
    if not 0.0 < moved < SHORTEST:
        return ""
    return f"it moves by {moved:.2g} in all, too little to work with, below {SHORTEST:g}; give it in a smaller unit."

"""Data CSV in and out: header with time, input, output, optional run and further columns; units in brackets.

Faults name file, row and column. Rows are counted as a text editor counts lines: the header is line 1.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.signals import Dataset, Record, joined

HEADER = re.compile(r"\s*(?P<name>[^\[\]]+?)\s*(?:\[(?P<unit>[^\]]*)\])?\s*")
KEEP_FAULTS = 8
"""Faults told of one file; a broken column has thousands."""


def read_data(files: Sequence[Path | str], output_needed: bool = True) -> Dataset:
    """One or more CSV files as a data set, all of it fitted. Raises UserError naming file, row, column."""
    datasets = [read_csv(Path(file), output_needed) for file in files]
    try:
        dataset = joined(*datasets)
    except ValueError as error:
        raise UserError(", ".join(str(file) for file in files), f"{error}.") from None
    first = dataset.records[0]
    for record in dataset.records[1:]:
        for column in ("time", "input", "output"):
            if record.units[column] != first.units[column]:
                raise UserError(
                    record.name,
                    f"{column} is in {record.units[column]}, but in {first.name} it is in {first.units[column]}.",
                )
    return dataset


def read_csv(path: Path, output_needed: bool = True) -> Dataset:
    """One CSV file: a record, or one a run where there is a run column."""
    frame, units = _table(path)
    required = ["time", "input", *(["output"] if output_needed else [])]
    missing = [name for name in required if name not in frame.columns]
    if missing:
        found = [f'no column "{name}". {nearest(name, frame.columns)}' for name in missing]
        raise UserError(str(path), found)
    numeric = [name for name in frame.columns if name in ("time", "input", "output") or _is_numeric(frame[name])]
    faults = _number_faults(frame, [name for name in numeric if name != "run"])
    if faults:
        raise UserError(str(path), faults)
    numbers = {name: frame[name].to_numpy(dtype=float) for name in numeric if name != "run"}
    runs = frame["run"].to_numpy() if "run" in frame else np.zeros(len(frame))
    records = []
    for run in dict.fromkeys(runs):
        rows = np.nonzero(runs == run)[0]
        name = f"{path.stem}:{run}" if "run" in frame else path.stem
        faults += _record_faults(numbers, rows, frame.index[rows], name, to_fit=output_needed)
        columns = {key: values[rows] for key, values in numbers.items() if key not in ("time", "input", "output")}
        output = numbers["output"][rows] if "output" in numbers else None
        records.append(
            Record(numbers["time"][rows], numbers["input"][rows], output, name=name, units=units, columns=columns)
        )
    if faults:
        raise UserError(str(path), faults[:KEEP_FAULTS])
    return Dataset(tuple(records))


def write_csv(path: Path, dataset: Dataset) -> None:
    """Write records as this module reads them; a run column only where there are several."""
    parts = []
    for record in dataset.records:
        columns = {"time": record.time, "input": record.input, "output": record.output, **record.columns}
        part = pd.DataFrame({_label(name, record.units): values for name, values in columns.items()})
        if len(dataset.records) > 1:
            part["run"] = record.name
        parts.append(part.iloc[record.history :])
    pd.concat(parts).to_csv(path, index=False, float_format="%.10g")


def _label(name: str, units: object) -> str:
    unit = units.get(name) if hasattr(units, "get") else None
    return f"{name} [{unit}]" if unit and unit != "1" else name


def _table(path: Path) -> tuple[pd.DataFrame, dict[str, str]]:
    """The cells as text, indexed by line number, with plain column names; and the units in brackets."""
    try:
        cells = pd.read_csv(path, header=None, dtype=str, keep_default_na=False, skip_blank_lines=False).fillna("")
    except (OSError, UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        reason = getattr(error, "strerror", None) or str(error).strip().splitlines()[0]
        raise UserError(str(path), f"cannot be read as CSV: {reason}.") from None
    cells.index += 1
    header, frame = cells.iloc[0], cells.iloc[1:]
    units = {"time": "s", "input": "1", "output": "1"}
    names = []
    for column in header:
        match = HEADER.fullmatch(column)
        names.append(match["name"].lower() if match else column)
        if match and match["unit"]:
            units[names[-1]] = match["unit"].strip()
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise UserError(str(path), [f'two columns are called "{name}".' for name in doubled])
    frame.columns = pd.Index(names)
    if not (frame != "").any(axis=None):
        raise UserError(str(path), "has a header but no samples.")
    return frame[(frame != "").any(axis=1)], units


def _is_numeric(column: pd.Series) -> bool:
    """A further column of text, such as a remark, is no fault: it is left out."""
    return bool(pd.to_numeric(column, errors="coerce").notna().mean() > 0.5)


def _number_faults(frame: pd.DataFrame, names: Sequence[str]) -> list[str]:
    faults = []
    for name in names:
        numbers = pd.to_numeric(frame[name].str.strip(), errors="coerce").to_numpy(dtype=float)
        bad = np.nonzero(~np.isfinite(numbers))[0]
        if bad.size:
            text, row = frame[name].iloc[bad[0]], frame.index[bad[0]]
            shown = f'"{text}"' if text.strip() else "empty"
            more = f" ({bad.size} such values in this column)" if bad.size > 1 else ""
            faults.append(f'row {row}, column "{name}": {shown} is not a finite number{more}.')
    return faults


def _record_faults(numbers: dict[str, Array], rows: Array, lines: pd.Index, name: str, to_fit: bool) -> list[str]:
    if rows.size < 2:
        return [f"record {name} has {rows.size} sample; at least 2 are needed."]
    faults = []
    time = numbers["time"][rows]
    back = np.nonzero(np.diff(time) <= 0)[0]
    if back.size:
        faults.append(
            f'row {lines[back[0] + 1]}, column "time": {time[back[0] + 1]:g} does not come after '
            f"{time[back[0]]:g}; time must strictly increase within a record."
        )
    if to_fit and np.ptp(numbers["input"][rows]) == 0:
        faults.append(
            f'record {name}, column "input": constant at {numbers["input"][rows[0]]:g}; nothing can be identified '
            f"from an input that does not move."
        )
    return faults

"""A sheet's columns as finite numbers: gaps left out and told, everything else that is no number a fault."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.csv_files import unguarded
from hysteresis_bench.data.layout import ROLES, Layout
from hysteresis_bench.data.readers.columns import KEEP_FAULTS, Named, named
from hysteresis_bench.data.readers.numbers import (
    NOT_A_NUMBER,
    OVERFLOW,
    is_missing,
    looks_like_a_number,
    number,
    seconds,
)
from hysteresis_bench.data.readers.replaced_time import another_rate
from hysteresis_bench.data.readers.sheet import Sheet
from hysteresis_bench.errors import UserError

HISTORY = "history"
"""A column of 1 for leading samples that are not scored, 0 for the others."""
LARGEST = 1e70
"""Largest number that can be worked with: tests take fourth powers of it, and sums of them over up to 1e14 pairs of
samples, which must stay below 1.8e308."""
GAPS = 0.2
"""Share of rows without a number that are gaps; more of them are a fault of the file."""
FEW_LINES = 5
"""Lines that a footer, or a header in the middle, has at most."""
MEASURED = re.compile(r"[-+]?[\d.,]+([eE][-+]?\d+)? ?[A-Za-z%°µμ/]+[\w/²³]*")
"""A number with a unit behind it."""
SHOWN = 4
"""Gaps that a sentence lists."""


@dataclass(frozen=True, eq=False)
class Columns:
    """A sheet with some columns of finite numbers.

    lines : (samples,) where each sample stands in the file;  units : the ones that the header states
    sheet : its name, empty where a file has but one;  understood : what was read, by the heading of a table
    behind_gap : (samples,) whether rows without a number were left out just before it
    notes : what was left out, a sentence each
    """

    lines: Array
    numbers: Mapping[str, Array]
    units: Mapping[str, str]
    runs: Sequence[str] | None
    behind_gap: Array
    sheet: str = ""
    understood: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def numbers_of(where: str, sheet: Sheet, layout: Layout, required: Sequence[str]) -> Columns:
    """The numeric columns of a sheet, the required ones among them. Raises UserError naming row and column."""
    found = named(where, sheet, layout, required)
    cells = found.cells
    if cells.dtypes.map(pd.api.types.is_numeric_dtype).all():
        filled = np.ones(len(cells), dtype=bool)
    else:
        filled = (cells != "").any(axis=1).to_numpy()
    cells = cells[filled]
    if not len(cells):
        raise UserError(where, "has a header but no samples.")
    numbers, empty, faults, notes = _numbers(cells, sheet.decimal, required)
    units = dict(found.units)
    if "time" in required and "time" in cells and not np.isfinite(numbers["time"]).any():
        since = seconds(cells["time"])
        if since is not None:
            numbers["time"], empty["time"], units["time"] = since[0], np.zeros(since[0].size, dtype=bool), "s"
            faults = [fault for fault in faults if 'column "time"' not in fault]
            notes.append(f"{since[1]} as seconds after the first")
    if layout.rate is not None:
        numbers["time"], units["time"] = np.arange(len(cells)) / layout.rate, "s"
        if found.replaced and (other := another_rate(*found.replaced, sheet.decimal, layout.rate)):
            notes.append(other)
    kept = ~np.any([empty[name] for name in empty] or [np.zeros(len(cells), dtype=bool)], axis=0)
    runs = _runs(cells["run"][kept], faults) if "run" in cells else None
    if faults:
        raise UserError(where, faults[:KEEP_FAULTS])
    lines = cells.index.to_numpy()
    if runs is None and "time" in numbers and (runs := _blocks(numbers["time"][kept], lines[kept])):
        notes.append("parted by empty lines into records")
    clauses = (*sheet.notes, *found.notes, *notes)
    told = [f"{where}: {', '.join(clauses)}."] if clauses else []
    gaps = _gaps(kept)
    if gaps:
        told.append(f"{where}: {_gap_words(gaps, lines)}")
    return Columns(
        lines[kept],
        {name: values[kept] for name, values in numbers.items()},
        units,
        runs,
        np.diff(np.flatnonzero(kept), prepend=-1) > 1,
        sheet.name,
        _understood(found, units, layout, gaps),
        tuple(told),
    )


def _numbers(
    cells: pd.DataFrame, decimal: str, required: Sequence[str]
) -> tuple[dict[str, Array], dict[str, Array], list[str], list[str]]:
    """Numbers by column; where the required ones are missing; faults; what was left out, as clauses."""
    numbers: dict[str, Array] = {}
    empty: dict[str, Array] = {}
    faults: list[str] = []
    holes: list[str] = []
    for name in cells.columns.drop("run", errors="ignore"):
        values = np.array([number(cell, decimal) for cell in cells[name]])
        values[values == NOT_A_NUMBER] = np.nan
        good = (np.abs(values) <= LARGEST) & (np.abs(values) != OVERFLOW)  # False for what is no number, too
        needed = name in required or name in ROLES
        if not (needed or np.mean(good) > 0.5):  # a further column of text, such as a remark, is left out
            continue
        numbers[name] = values
        if np.all(good):
            continue
        missing = ~good & np.array([is_missing(cell) for cell in cells[name]])
        few = np.mean(missing) <= GAPS
        if needed and few:
            empty[name] = missing
        elif not needed and np.any(missing):
            holes.append(name)
            del numbers[name]
            continue
        wrong = np.nonzero(~good & ~missing if needed and few else ~good)[0]
        if wrong.size:
            faults.append(_fault(cells, name, wrong, decimal, int(np.count_nonzero(missing))))
    return numbers, empty, faults, [f"left out, because cells are empty: {', '.join(holes)}"] if holes else []


def _fault(table: pd.DataFrame, name: str, bad: Array, decimal: str, missing: int) -> str:
    """The sentence on a column's cells that are no numbers.

    bad : rising indices of these cells;  missing : how many cells of the column say that there is no number
    """
    cells = table[name]
    text, value = str(cells.iloc[bad[0]]).strip(), number(cells.iloc[bad[0]], decimal)
    shown = f'"{text[:40]}"' if text else "empty"
    too_large = math.isfinite(value) or (math.isinf(value) and any(letter.isdigit() for letter in text))
    why = "is not a finite number"
    if too_large:
        why = f"is too large to work with, beyond {LARGEST:g}"
        why = "is what instruments write for an overflow" if abs(value) == OVERFLOW else why
    more = f" ({bad.size} such values in this column)" if bad.size > 1 else ""
    measured = [str(table[role].iloc[bad[0]]) for role in ROLES if role in table]
    helps = ""
    if bad.size == len(cells) and not text:
        helps = " The column is empty; where a spreadsheet's formulas have no values yet, open it there and save it."
    elif GAPS * len(cells) < missing < len(cells) and is_missing(cells.iloc[bad[0]]):
        other = f", or give another column with --{name} NAME" if name in ROLES else ""
        helps = (
            f" {missing} of {len(cells)} cells hold no number; up to a fifth of them may, and are left out as gaps. "
            f"Take the rows without a reading out of the file{other}."
        )
    elif not too_large and decimal == "." and math.isfinite(number(text, ",")):
        helps = " Is it a decimal comma? Say so with --decimal ,"
    elif not too_large and decimal == "," and math.isfinite(number(text, ".")):
        helps = " Is it a decimal point? Say so with --decimal ."
    elif not too_large and MEASURED.fullmatch(text):
        helps = " Take the unit out of the cells, into the header."
    elif bad.size == len(cells) and not too_large and name in ROLES:
        rate = ", or --rate HZ" if name == "time" else ""
        helps = f" The column holds no number at all; give another with --{name} NAME{rate}."
    elif bad.size <= FEW_LINES and (name == "time" or not any(map(looks_like_a_number, measured))):
        helps = " If the line is no sample, take it out, or begin it with #."
    elif name == "time":
        helps = " Give --rate HZ in place of the time."
    elif bad.size <= GAPS * len(cells):
        helps = " Empty the cell where there was no reading, and its sample is left out."
    elif too_large and abs(value) != OVERFLOW:
        helps = " Give the column in a larger unit."
    return f'row {cells.index[bad[0]]}, column "{name}": {shown} {why}{more}.{helps}'


def _runs(cells: pd.Series, faults: list[str]) -> list[str] | None:
    """The name of every sample's record; None where none has a name. A fault is added where only some have one."""
    unnamed = cells.isna() | (cells.map(str).str.strip() == "")
    if unnamed.all():
        return None
    if unnamed.any():
        rows = [str(row) for row in cells.index[unnamed]]
        listed = ", ".join(rows[:SHOWN]) + (f" and {len(rows) - SHOWN} more" if len(rows) > SHOWN else "")
        faults.append(
            f'column "run": empty in row{"s" if len(rows) > 1 else ""} {listed}, so that nobody knows whose samples '
            "these are. Name their record there, or take the rows out."
        )
    return [unguarded(run) for run in cells.map(str)]


def _blocks(time: Array, lines: Array) -> list[str] | None:
    """Names of records that empty lines part, where the time begins anew at every one of them; None without any."""
    back = np.diff(time) <= 0.0
    if not back.any() or np.any(np.diff(lines)[back] < 2):
        return None
    return [str(1 + number) for number in np.concatenate(([0], np.cumsum(back)))]


def _gaps(kept: Array) -> list[tuple[int, int]]:
    """First and last sample of every gap."""
    edges = np.flatnonzero(np.diff(np.concatenate(([True], kept, [True])).astype(int)))
    return [(int(low), int(high) - 1) for low, high in zip(edges[::2], edges[1::2], strict=True)]


def _gap_words(gaps: Sequence[tuple[int, int]], lines: Array) -> str:
    rows = [f"{lines[low]}" if low == high else f"{lines[low]}-{lines[high]}" for low, high in gaps]
    samples = sum(high - low + 1 for low, high in gaps)
    more = f" and {len(gaps) - SHOWN} more" if len(gaps) > SHOWN else ""
    where = ", ".join(rows[:SHOWN]) + more
    one = samples == 1
    return (
        f"{samples} row{'' if one else 's'} without a number left out ({'row' if one else 'rows'} {where}); "
        f"across a gap the input is taken to have gone straight on."
    )


def _understood(
    found: Named, units: Mapping[str, str], layout: Layout, gaps: Sequence[tuple[int, int]]
) -> dict[str, str]:
    """How the columns were read, by the heading of a table."""

    def told(role: str) -> str:
        if role == "time" and layout.rate is not None:
            return f"{layout.rate:g} Hz as given"
        source = found.sources.get(role)
        if source is None:
            return ""
        unit = units.get(role)
        plain = source in (role, f"{role} [{unit}]")
        if unit and not plain and unit in source:
            return source
        return f"{'' if plain else source + ', '}{'in ' + unit if unit else 'no unit'}"

    return {**{role: told(role) for role in ROLES}, "gaps": str(len(gaps))}

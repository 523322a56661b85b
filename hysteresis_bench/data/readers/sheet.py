"""A sheet: columns of cells with a header, wherever they came from; and where its header and its numbers begin."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import pandas as pd

from hysteresis_bench.data.csv_files import unguarded
from hysteresis_bench.data.layout import ALIASES, ROLES
from hysteresis_bench.data.readers.numbers import looks_like_a_number
from hysteresis_bench.data.units import is_unit

SQUARE = re.compile(r"(?P<name>[^\[\]]+)(?:\[(?P<unit>[^\[\]]*)\])?")
ROUND = re.compile(r"(?P<name>[^()]*[^()\s])\s*\((?P<unit>[^()]+)\)")
SPELLED_OUT = re.compile(r"(?P<name>.*\S)\s+(?:/|in)\s+(?P<unit>\S+)")
TIMED = re.compile(r"(?P<name>t|time|zeit)[_:.-](?P<unit>[numµμ]?s|m?sec|min|h)", re.IGNORECASE)
BRACKETS = re.compile(r"[\[(](.*)[\])]")
LONGEST_NAME = 200
"""Characters of a column's name."""
FEW_ROWS = 3
"""Rows by which data are told from a line of a preamble."""
TOP = 100
"""Rows among which a header is looked for."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """A table with a header.

    name : of the sheet or variable, empty where a file has but one
    headers : as they stand in the file; empty where it has none;  units : of a line of units, empty where there is none
    cells : text or numbers, a row a sample, indexed by where it stands in the file (from 1)
    decimal : "." or ",";  notes : how it was read, as clauses
    left : names of what the file holds beside and is no column of numbers, with the reason
    """

    name: str
    headers: tuple[str, ...]
    units: tuple[str, ...]
    cells: pd.DataFrame
    decimal: str = "."
    notes: tuple[str, ...] = field(default_factory=tuple)
    left: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Top:
    """Where things stand among the first rows; data : the first row of samples."""

    header: int | None
    units: int | None
    data: int


def parted(header: str) -> tuple[str, str | None]:
    """`Voltage (V)` -> ("Voltage", "V"), as `Voltage / V`, `Voltage in V` and `time_ms`; where a unit stands in no
    square brackets, it must be one that is known."""
    text = unguarded(header.strip())
    if match := SQUARE.fullmatch(text):
        unit = (match["unit"] or "").strip()
        if unit:
            return match["name"].strip(), unit
        text = match["name"].strip()
    for form in (ROUND, SPELLED_OUT, TIMED):
        if (match := form.fullmatch(text)) and is_unit(match["unit"]):
            return match["name"].strip(), match["unit"].strip()
    return text, None


def together(sheets: Sequence[Sheet]) -> Sheet:
    """The columns of all sheets of the commonest length as one sheet, each with its sheet's name before its own."""
    lengths = [len(sheet.cells) for sheet in sheets]
    length = max(lengths, key=lengths.count)
    alike = [sheet for sheet in sheets if len(sheet.cells) == length]
    headers = []
    for sheet in alike:
        names = sheet.headers or tuple(str(number + 1) for number in range(sheet.cells.shape[1]))
        headers += [f"{sheet.name}/{name}".lstrip("/") for name in names]
    cells = pd.concat([sheet.cells.reset_index(drop=True) for sheet in alike], axis=1)
    cells.columns = pd.RangeIndex(cells.shape[1])
    cells.index = alike[0].cells.index
    return Sheet("", tuple(headers), (), cells, alike[0].decimal)


def top_of(rows: Sequence[Sequence[str]], wanted: Iterable[str | None]) -> Top:
    """Where header, line of units and samples stand; wanted : names that the user gave to columns."""
    names = {role: {role, *ALIASES[role]} for role in ROLES}
    asked = {name.strip().lower() for name in wanted if name}
    for index, row in enumerate(rows):
        plain = {parted(cell)[0].lower() for cell in row if len(cell) <= LONGEST_NAME}
        plain |= {cell.strip().lower() for cell in row}
        hits = sum(bool(known & plain) for known in names.values()) + len(asked & plain)
        if hits >= min(2, len(row)):
            return _with_units(rows, index)
    first = next((index for index in range(len(rows)) if _begins_data(rows[index : index + FEW_ROWS])), None)
    if first is None:
        return _with_units(rows, 0)
    above = [index for index in range(first) if len(rows[index]) == len(rows[first])]
    if first and len(rows[first - 1]) > len(rows[first]) and _is_text(rows[first - 1]):  # names for more than there is
        above = [*above, first - 1]
    if not above:
        return Top(None, None, first)
    last = above[-1]
    before = above[-2] if len(above) > 1 else None
    if before is not None and is_unit_row(rows[last]) and _is_text(rows[before]):
        return Top(before, last, first)
    return Top(last, None, first) if _is_text(rows[last]) else Top(None, None, first)


def is_unit_row(row: Sequence[str]) -> bool:
    """Whether a row says nothing but units: `s;V;um` or `(s);(V);(um)`."""
    said = [match[1] if (match := BRACKETS.fullmatch(cell.strip())) else cell.strip() for cell in row]
    filled = [text for text in said if text]
    return bool(filled) and not _is_data(row) and all(is_unit(text) or text in ("-", "sample") for text in filled)


def units_in(row: Collection[str]) -> tuple[str, ...]:
    """The units of a row of units, empty where a column has none."""
    said = (match[1] if (match := BRACKETS.fullmatch(cell.strip())) else cell.strip() for cell in row)
    return tuple("1" if text == "-" else text for text in said)


def _with_units(rows: Sequence[Sequence[str]], header: int) -> Top:
    below = next((index for index in range(header + 1, len(rows)) if any(cell.strip() for cell in rows[index])), None)
    if below is not None and is_unit_row(rows[below]):
        return Top(header, below, below + 1)
    return Top(header, None, header + 1)


def _begins_data(rows: Sequence[Sequence[str]]) -> bool:
    """Whether these rows are data, and no lone line of a preamble such as `Samples 400 400`."""
    return all(_is_data(row) for row in rows) and len({len(row) for row in rows[:2]}) == 1


def _is_data(row: Sequence[str]) -> bool:
    filled = [cell for cell in row if cell.strip()]
    return len(filled) > 0 and sum(map(looks_like_a_number, filled)) * 2 > len(filled)


def _is_text(row: Sequence[str]) -> bool:
    return any(cell.strip() for cell in row) and not any(looks_like_a_number(cell) for cell in row if cell.strip())

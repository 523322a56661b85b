"""CSV as a file of cells: read as text, written so that no text in it is a formula to a spreadsheet.

A text that begins with = + - or @ and is no number gets an apostrophe before it, and loses it where it is read.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from pathlib import Path

import pandas as pd

FORMULA = re.compile(r"'*[=+\-@\t\r]")
GUARDED = re.compile(r"''*[=+\-@\t\r]")


def guarded(text: str) -> str:
    """A text as it may stand in a cell; `unguarded` gives it back."""
    return f"'{text}" if FORMULA.match(text) and not is_number(text) else text


def unguarded(cell: str) -> str:
    """The text that a cell was written from."""
    return cell[1:] if GUARDED.match(cell) else cell


def is_number(text: str) -> bool:
    """Whether a text reads as a number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def read_table(path: Path, texts: Collection[str] = ()) -> pd.DataFrame:
    """A table that `write_table` wrote.  texts : columns that are none of numbers, though all of a cell may look so"""
    return _with_texts(pd.read_csv(path, dtype=dict.fromkeys(texts, str)), unguarded)


def write_table(path: Path, table: pd.DataFrame, *, digits: int | None = None, index: bool = False) -> None:
    """Write a table beside and rename it, its texts guarded, compressed where the name ends in .xz.

    digits : significant ones of a number, all by default
    """
    safe = _with_texts(table.reset_index() if index else table, guarded)
    beside = path.with_name(f"{path.name}.part")
    compression = "xz" if path.suffix == ".xz" else None
    safe.to_csv(beside, index=False, float_format=None if digits is None else f"%.{digits}g", compression=compression)
    beside.replace(path)  # a stop in between leaves no half a table


def _with_texts(table: pd.DataFrame, change: Callable[[str], str]) -> pd.DataFrame:
    """The table with every text changed, in its cells and in its header."""

    def changed(value: object) -> object:
        return change(value) if isinstance(value, str) else value

    texts = [name for name in table if not pd.api.types.is_numeric_dtype(table[name])]
    return table.assign(**{name: table[name].map(changed) for name in texts}).rename(columns=changed)

"""Arrays of a file as sheets: which of them are columns, and what is left out, named with the reason."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.data.readers.sheet import Sheet
from hysteresis_bench.errors import UserError

OBJECTS = object()
"""Stands for an array of objects, which is not loaded."""
MOST_COLUMNS = 64
"""Columns of an array beyond which it is no table of samples."""
LISTED = 12
"""Arrays that a sentence names at most."""


def sheets_of(path: Path, stored: Mapping[str, Any]) -> list[Sheet]:
    """Columns of one length as a sheet; a table of numbers and a structure as a sheet of its own.

    The first sheet's notes name what is left out. Raises UserError where nothing is a column.
    """
    left: dict[str, str] = {}
    sheets = _sheets(stored, "", left)
    named = ", ".join(f"{name} ({why})" for name, why in list(left.items())[:LISTED])
    named += f" and {len(left) - LISTED} more" if len(left) > LISTED else ""
    if left and not sheets:
        raise UserError(str(path), f"holds no columns of numbers, only {named}.")
    sheets = [replace(sheet, left=left) for sheet in sheets]
    if left:
        sheets[0] = replace(sheets[0], notes=(*sheets[0].notes, f"left out: {named}"))
    return sheets


def _sheets(stored: Mapping[str, Any], prefix: str, left: dict[str, str]) -> list[Sheet]:
    """left : names of what is left out, with the reason; what is found is added"""
    columns, sheets = {}, []
    for name, value in stored.items():
        whole = f"{prefix}{name}"
        if isinstance(value, Mapping):
            sheets += _sheets(value, f"{whole}/", left)
            continue
        value = _filled(value)
        array = np.asarray(value)
        if array.dtype.names:
            sheets += _sheets({each: array[each] for each in array.dtype.names}, f"{whole}/" if whole else "", left)
            continue
        if array.dtype.kind in "mM" and array.size:
            array, name = (array - array.ravel()[0]) / np.timedelta64(1, "s"), f"{name} [s]"
        array = np.squeeze(array.real if array.dtype.kind == "c" and not np.any(array.imag) else array)
        if why := _no_columns(value, array):
            left[whole] = why
        elif array.ndim == 1 and array.size > 1:
            columns[name] = array.astype(float)
        elif array.ndim == 2:
            notes = ("its rows are the columns",) if array.shape[0] < array.shape[1] else ()
            upright = array.T if notes else array
            sheets.append(Sheet(whole, (), (), _indexed(pd.DataFrame(upright.astype(float))), notes=notes))
    if columns:
        length = Counter(array.size for array in columns.values()).most_common(1)[0][0]
        short = [name for name, array in columns.items() if array.size != length]
        kept = {name: array for name, array in columns.items() if array.size == length}
        notes = (f"left out, because of another length: {', '.join(short)}",) if short else ()
        frame = _indexed(pd.DataFrame(kept))
        headers = tuple(frame.columns)
        frame.columns = pd.RangeIndex(len(headers))
        sheets.insert(0, Sheet(prefix.rstrip("/"), headers, (), frame, notes=notes))
    return sheets


def _filled(value: Any) -> Any:
    """A sparse matrix with few columns as an array; anything else as it is."""
    return value.toarray() if hasattr(value, "toarray") and min(value.shape) <= MOST_COLUMNS else value


def _no_columns(value: Any, array: Any) -> str:
    """Why an array is neither a column nor a table of them; "" where it is, or is a lone number or word."""
    if value is OBJECTS or hasattr(value, "toarray"):
        return "objects" if value is OBJECTS else f"a sparse matrix of {min(value.shape)} columns"
    if array.size < 2:
        return ""
    if array.dtype.kind == "c":
        return "complex numbers"
    if array.dtype.kind not in "fiub":
        return "text" if array.dtype.kind in "SU" else "objects"
    if array.ndim > 2:
        return f"{array.ndim} dimensions"
    return f"{min(array.shape)} columns" if array.ndim == 2 and min(array.shape) > MOST_COLUMNS else ""


def _indexed(frame: pd.DataFrame) -> pd.DataFrame:
    frame.index = pd.RangeIndex(1, len(frame) + 1)
    return frame

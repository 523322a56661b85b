"""Data files of any kind that is known as sheets: text, spreadsheets, and files of arrays."""

from __future__ import annotations

import stat
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.data.layout import Layout
from hysteresis_bench.data.readers.apart import read_apart
from hysteresis_bench.data.readers.arrays import OBJECTS, sheets_of
from hysteresis_bench.data.readers.numbers import Ambiguous, decimal_mark
from hysteresis_bench.data.readers.sheet import TOP, Sheet, top_of, units_in
from hysteresis_bench.data.readers.text import read_text
from hysteresis_bench.errors import UserError, nearest

OLD = {
    **dict.fromkeys((".xls", ".xlsb", ".ods"), "save it as .xlsx"),
    **dict.fromkeys((".parquet", ".tdms", ".json", ".html", ".xml", ".wav", ".rds", ".sav"), "save it as CSV"),
    **dict.fromkeys((".zip", ".gz", ".bz2", ".xz", ".7z", ".rar", ".tar"), "unpack it first"),
    **dict.fromkeys((".pkl", ".pickle", ".joblib"), "save plain arrays as .npz"),
    ".pdf": "save what its tables were made from as CSV",
}
DATA = (".csv", ".txt", ".tsv", ".dat", ".xlsx", ".mat", ".npz", ".npy", ".h5", ".hdf5")
NUMPYS = (b"\x93NUMPY", b"PK\x03\x04", b"PK\x05\x06")
"""What files of NumPy begin with: an array, an archive of arrays, an empty one."""
REFUSED = "Object arrays cannot be loaded"
"""How numpy says that an array holds no numbers."""
MATLABS_OWN, DEEPEST = ("#refs#", "#subsystem#"), 8
"""Groups of MATLAB 7.3 that hold what others point at; levels of groups that are looked into."""


def read_sheets(path: Path, layout: Layout) -> list[Sheet]:
    """Every sheet or variable of a file that holds columns; the one that the layout names, where it names one.

    Raises UserError for what cannot be read, or holds none.
    """
    try:
        if path.is_dir():
            such = f"name its files, such as {found[0]}." if (found := _files(path)) else "it holds no data files."
            raise UserError(str(path), f"is a folder; {such}")
        if not stat.S_ISREG(path.stat().st_mode):
            raise UserError(str(path), "is no file that can be read twice, but a pipe or a device.")
        sheets = _read(path, layout)
    except FileNotFoundError:
        close = get_close_matches(str(path), _files(path.parent), n=1)
        meant = f' Did you mean "{close[0]}"?' if close else ""
        raise UserError(str(path), f"there is no such file.{meant}") from None
    except OSError as error:
        reason = error.strerror or str(error).split("\n")[0]
        raise UserError(str(path), f"cannot be read as {_kind(path)}: {reason}.") from None
    if layout.sheet is not None:
        known = [sheet.name for sheet in sheets]
        sheets = [sheet for sheet in sheets if sheet.name == layout.sheet]
        if not sheets:
            raise UserError(str(path), _no_sheet(layout.sheet, [name for name in known if name]))
    if not sheets:
        raise UserError(str(path), "holds no columns of numbers.")
    return sheets


def _no_sheet(asked: str, known: Sequence[str]) -> str:
    if not known:
        return f'no sheet or variable "{asked}": this file has none to choose from. Leave --sheet out.'
    return f'no sheet or variable "{asked}". {nearest(asked, known)}'


def _files(folder: Path) -> list[str]:
    """What a folder holds that looks like data, as paths."""
    return sorted(str(one) for one in folder.iterdir() if one.suffix.lower() in DATA) if folder.is_dir() else []


def _kind(path: Path) -> str:
    return {".xlsx": "a spreadsheet", ".xlsm": "a spreadsheet", ".mat": "MATLAB data", ".h5": "HDF5"}.get(
        path.suffix.lower(), "arrays" if path.suffix.lower() in (".npz", ".npy") else "CSV"
    )


def _read(path: Path, layout: Layout) -> list[Sheet]:
    suffix = path.suffix.lower()
    if suffix in OLD:
        raise UserError(str(path), f"files of this kind are not read; {OLD[suffix]}.")
    if suffix in (".xlsx", ".xlsm"):
        return _spreadsheet(path, layout)
    if suffix in (".npz", ".npy"):
        return sheets_of(path, _numpy(path))
    if suffix == ".mat":
        return read_apart(lambda: sheets_of(path, _matlab(path)), path, _kind(path))
    if suffix in (".h5", ".hdf5", ".hdf"):
        return read_apart(lambda: sheets_of(path, _hdf5(path)), path, "HDF5")
    return [read_text(path, layout)]


def _library(name: str, path: Path) -> Any:
    """A library that is an extra. Raises UserError where it is not installed."""
    try:
        return import_module(name)
    except ImportError:
        wanted = f'needs the package {name}; install it with: pip install "hysteresis-bench[files]".'
        raise UserError(str(path), wanted) from None


def _spreadsheet(path: Path, layout: Layout) -> list[Sheet]:
    openpyxl = _library("openpyxl", path)
    try:
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
        pages = [(page.title, [list(row) for row in page.iter_rows(values_only=True)]) for page in book.worksheets]
        book.close()
    except Exception as error:  # a damaged archive raises errors of any type
        raise UserError(str(path), f"cannot be read as a spreadsheet: {str(error).splitlines()[0]}.") from None
    found = []
    for title, values in pages:
        values = [["" if cell is None else cell for cell in row] for row in values]
        rows = [[str(cell) for cell in row] for row in values]
        filled = [index for index, row in enumerate(rows) if any(cell.strip() for cell in row)]
        if not filled:
            continue
        top = top_of([rows[index] for index in filled[:TOP]], (layout.time, layout.input, layout.output))
        lines = filled[top.data :]
        kept = [[cell if type(cell) in (int, float) else str(cell) for cell in values[index]] for index in lines]
        cells = pd.DataFrame(kept, index=[index + 1 for index in lines])
        texts = ((index + 1, cell) for index in lines for cell in values[index] if isinstance(cell, str))
        try:
            decimal = layout.decimal or decimal_mark(texts)
        except Ambiguous as error:
            raise UserError(str(path), f"{title}, {error}") from None
        header = () if top.header is None else tuple(rows[filled[top.header]])
        units = () if top.units is None else units_in(rows[filled[top.units]])
        named = len(pages) > 1 or layout.sheet is not None  # of a lone one nobody needs the name
        found.append(Sheet(title if named else "", header, units, cells, decimal))
    return found


def _numpy(path: Path) -> Mapping[str, Any]:
    with path.open("rb") as file:
        if not file.read(max(map(len, NUMPYS))).startswith(NUMPYS):
            told = (
                "is no file of NumPy's arrays, whatever its name says: it begins otherwise. Where it is text, name it"
            )
            raise UserError(str(path), f"{told} .csv.")
    try:
        stored = np.load(path, allow_pickle=False)
        if isinstance(stored, np.ndarray):
            return {"": stored}
        return {name: _unless_of_objects(stored, name) for name in stored.files}
    except OSError:
        raise
    except Exception as error:  # a damaged archive raises errors of any type
        reason = (str(error).splitlines() or ["it is damaged"])[0].rstrip(".")
        told = reason if REFUSED not in str(error) else "it holds objects. Save plain arrays of numbers"
        raise UserError(str(path), f"cannot be read as arrays: {told}.") from None


def _unless_of_objects(stored: Any, name: str) -> Any:
    try:
        return stored[name]
    except ValueError as error:
        if REFUSED in str(error):
            return OBJECTS
        raise


def _matlab(path: Path) -> Mapping[str, Any]:
    from scipy.io import loadmat

    try:
        stored = loadmat(path, squeeze_me=True, struct_as_record=False, chars_as_strings=True)
    except NotImplementedError:  # version 7.3 is HDF5
        return _hdf5(path)
    except OSError:
        raise
    except Exception as error:
        raise UserError(str(path), f"cannot be read as MATLAB data: {str(error).splitlines()[0]}.") from None
    return {name: _plain(value) for name, value in stored.items() if not name.startswith("__")}


def _plain(value: Any) -> Any:
    """A MATLAB structure as a mapping; of cells and of an array of structures, a mapping by number."""
    if hasattr(value, "_fieldnames"):
        return {name: _plain(getattr(value, name)) for name in value._fieldnames}
    if isinstance(value, np.ndarray) and value.dtype == object:
        return {str(number): _plain(one) for number, one in enumerate(value.ravel(order="F"), start=1)}
    return value


def _hdf5(path: Path) -> Mapping[str, Any]:
    h5py = _library("h5py", path)

    def contents(items: Iterable[tuple[str, Any]], depth: int = 0) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for name, item in items:
            if name in MATLABS_OWN or depth > DEEPEST:
                continue
            if isinstance(item, h5py.Group):
                found[name] = contents(item.items(), depth + 1)
            elif h5py.check_ref_dtype(item.dtype) is h5py.Reference:  # MATLAB's cells
                pointed = (item.file[one] for one in np.ravel(item[()], order="F") if one)
                found[name] = contents(((str(n), one) for n, one in enumerate(pointed, start=1)), depth + 1)
            elif item.dtype.names:
                found[name] = {field: item[field] for field in item.dtype.names}
            else:
                unit = next((item.attrs[key] for key in ("units", "unit") if key in item.attrs), "")
                text = unit.decode() if isinstance(unit, bytes) else str(unit)
                found[f"{name} [{text}]" if text else name] = item[()]
        return found

    try:
        with h5py.File(path, "r") as file:
            return contents(file.items())
    except UserError:
        raise
    except Exception as error:  # a damaged file raises errors of any type
        reason = (str(error).splitlines() or ["it is damaged"])[0]
        raise UserError(str(path), f"cannot be read as HDF5: {reason}.") from None

"""Text files as a sheet: encoding, comments, delimiter, header, decimal mark."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from hysteresis_bench.data.layout import Layout
from hysteresis_bench.data.readers.clocks import clocked
from hysteresis_bench.data.readers.numbers import Ambiguous, decimal_mark, looks_like_a_number
from hysteresis_bench.data.readers.sheet import LONGEST_NAME, TOP, Sheet, top_of, units_in
from hysteresis_bench.errors import UserError

COMMENT = re.compile(r"\s*(#|%|//|!)")
CANDIDATES = ("\t", ";", "|", ",", " ")
"""In the order in which they are believed where two do as well."""
NAMES = {"\t": "tabs", ";": "semicolons", "|": "bars", ",": "commas", " ": "blanks"}
SINGLE, FEW_CELLS = re.compile(r"(?<![^;,|\s])'([^'\"\n]*)'(?![^;,|\s])"), 2
"""A cell in single quotes; so many in the first lines make it a custom of the file."""
PADDING, CONTROL = b"\0\x1a\r\n", re.compile(rb"[\0-\x08\x0e-\x1f]")
"""Bytes that old programs and loggers leave at the end of a file; bytes that no text has."""
QUOTED = re.compile(r'"[^"]*"|\S+')
"""A cell between blanks, which it may hold where it is quoted."""
LINES = 20
"""Lines that a header may be broken into, within its quotes."""
MARKUP = re.compile(r"\s*(<[!?A-Za-z]|\{\s*[\"}]|\[\s*[{\[])")
SAMPLE = 2000
"""Bytes by which an encoding is told."""
MARKS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))


def read_text(path: Path, layout: Layout) -> Sheet:
    """The sheet of a text file. Raises UserError for what is no text, no table, or ambiguous."""
    text, notes = _decoded(path)
    text = _double_quoted(text.replace("\r\n", "\n").replace("\r", "\n"))
    lines = _with_whole_header(text.split("\n"))
    if not any(line.strip() for line in lines):
        raise UserError(str(path), "is empty.")
    if MARKUP.match(text):
        raise UserError(str(path), "cannot be read as CSV: it is JSON, HTML or XML; save it as CSV.")
    comments = [index for index, line in enumerate(lines) if COMMENT.match(line) and not _is_header(line, layout)]
    plain = [index for index in range(len(lines)) if lines[index].strip() and index not in set(comments)]
    if not plain:
        raise UserError(str(path), "cannot be read as CSV: it holds comments only.")
    head = plain[:TOP]
    mark = layout.mark or _delimiter([lines[index] for index in head])
    if clock := clocked(lines, mark):
        lines, told = clock
        notes.append(told)
    rows = [_cells(lines[index], mark) for index in head]
    top = top_of(rows, (layout.time, layout.input, layout.output))
    header = () if top.header is None else tuple(rows[top.header])
    if top.header is not None and mark == " " and top.data < len(rows):
        width = len(rows[top.data])
        if len(header) > width or not header:
            header = _names_with_blanks(lines[head[top.header]], width)
    units = () if top.units is None else units_in(rows[top.units])
    first = plain[top.data] if top.data < len(plain) else len(lines)
    if not header:
        header = _header_in_comment(lines, [index for index in comments if index < first], mark, rows, top.data)
    trailing = _trailing([lines[index] for index in head[top.header or 0 :]], mark, len(header))
    width = len(header) + max(trailing, 0) if header else 0
    cells = _table(path, lines, first, set(comments), mark, width=width)
    above = top.data - (top.header is not None) - (top.units is not None)
    if samples := [head[at] + 1 for at in range(top.header or 0) if _numbers(rows[at], len(header))]:
        raise UserError(str(path), f"row {samples[0]} holds samples above the header; put the header first.")
    if mark != ",":
        notes.append(f"{NAMES[mark]} between cells")
    if above:
        notes.append(f"{above} line{'s' if above > 1 else ''} above the header left out")
    decimal = _decimal(path, cells, layout, unquoted=mark == "," and '"' not in text)
    if decimal == ",":
        notes.append("decimal commas")
    return Sheet("", header, units, cells, decimal, tuple(notes))


def _decoded(path: Path) -> tuple[str, list[str]]:
    """The text, and notes on how it was encoded."""
    raw = path.read_bytes()
    for mark, encoding in MARKS:
        if raw.startswith(mark):
            try:
                return raw.decode(encoding), [] if encoding == "utf-8-sig" else ["UTF-16 text"]
            except UnicodeDecodeError:
                raise UserError(str(path), "cannot be read as CSV: its text is damaged.") from None
    if b"\0" in raw and not raw[1:SAMPLE:2].strip(b"\0"):
        return raw[: len(raw) // 2 * 2].decode("utf-16-le", errors="replace"), ["UTF-16 text"]
    text = raw.rstrip(PADDING)
    notes = ["zeros behind the end left out"] if text and b"\0" in raw[len(text) :] else []
    if CONTROL.search(text):
        raise UserError(str(path), "cannot be read as CSV: it is not text. Known: text, .xlsx, .mat, .npz, .npy, .h5.")
    try:
        return text.decode("utf-8"), notes
    except UnicodeDecodeError:
        return text.decode("cp1252", errors="replace"), [*notes, "read as Windows text (cp1252), since it is not UTF-8"]


def _double_quoted(text: str) -> str:
    """The text with double quotes about its cells where the first lines have single ones."""
    first = text[: 50 * LONGEST_NAME]
    if len(SINGLE.findall(first)) < FEW_CELLS or '"' in first:
        return text
    return SINGLE.sub(r'"\1"', text)


def _with_whole_header(lines: list[str]) -> list[str]:
    """The lines, a header whose quoted cells are broken into lines as one, empty ones after it."""
    for count in range(1, min(LINES, len(lines)) if lines[0].count('"') % 2 else 1):
        whole = " ".join(lines[: count + 1])
        if whole.count('"') % 2 == 0:
            return [whole, *[""] * count, *lines[count + 1 :]]
    return lines


def _is_header(line: str, layout: Layout) -> bool:
    """A header may begin with a comment's mark where the user names a column so."""
    named = [name for name in (layout.time, layout.input, layout.output) if name]
    return any(COMMENT.match(name) and line.strip().startswith(name) for name in named)


def _cells(line: str, mark: str, trim: bool = True) -> list[str]:
    """A line's cells; trim : leave out what is empty behind a trailing delimiter."""
    if mark == " ":
        return [cell.strip('"') for cell in QUOTED.findall(line)]
    try:
        cells = next(csv.reader([line], delimiter=mark), [])
    except csv.Error:
        cells = line.split(mark)
    return cells[:-1] if trim and len(cells) > 1 and not cells[-1].strip() else cells


def _trailing(lines: Sequence[str], mark: str, width: int) -> int:
    """How many empty cells lines have behind a header's."""
    rows = (_cells(line, mark, trim=False) for line in lines)
    return max((len(cells) - width for cells in rows if not any(map(str.strip, cells[width:]))), default=0)


def _delimiter(lines: Sequence[str]) -> str:
    """The mark by which most cells of most lines are numbers; a comma where none is better."""
    best, most = ",", 0.0
    for mark in CANDIDATES:
        rows = [_cells(line[: 50 * LONGEST_NAME], mark) for line in lines]
        width = Counter(map(len, rows)).most_common(1)[0][0]
        if width < 2:
            continue
        share = sum(sum(map(looks_like_a_number, row)) / width for row in rows if len(row) == width)
        if share / len(rows) > most + 1e-9:
            best, most = mark, share / len(rows)
    if most > 0.0:
        return best
    counts = {mark: lines[0].count(mark) for mark in (",", *CANDIDATES[:3])}  # no numbers at all: the header decides
    return max(counts, key=lambda mark: counts[mark])


def _header_in_comment(
    lines: Sequence[str], comments: Sequence[int], mark: str, rows: Sequence[Sequence[str]], data: int
) -> tuple[str, ...]:
    """The last comment before the numbers, where it has a name for every column."""
    if not comments or data >= len(rows):
        return ()
    bare = COMMENT.sub("", lines[comments[-1]], count=1).strip()
    cells = _cells(bare, mark)
    if len(cells) == len(rows[data]) and not any(map(looks_like_a_number, cells)):
        return tuple(cell.strip() for cell in cells)
    return _names_with_blanks(bare, len(rows[data]))


def _names_with_blanks(line: str, count: int) -> tuple[str, ...]:
    """As many names as there are columns, parted by blanks, which may stand before a unit or within a name, too."""
    line = line.strip()
    joined = re.sub(r"\s+(?=[(\[])", "\0", line)  # a unit in brackets stays with its name
    for cells in (line.split(), joined.split(), re.split(r"\s{2,}|\t", line), re.split(r"\s{2,}|\t", joined)):
        names = tuple(cell.replace("\0", " ").strip() for cell in cells)
        if len(names) == count and not any(map(looks_like_a_number, names)):
            return names
    return ()


def _table(path: Path, lines: Sequence[str], first: int, comments: set[int], mark: str, width: int) -> pd.DataFrame:
    """The cells from line `first` on, indexed by the lines they stand in; comments and blank lines left out."""
    if first >= len(lines):
        return pd.DataFrame(columns=range(width), dtype=str)
    body = ["" if index in comments else lines[index] for index in range(first, len(lines))]
    names = mark.join(["x"] * width) if width else None  # pandas takes the width from the first line
    text = "\n".join([*([names] if names else []), *body]) + "\n"
    options = {"sep": r"\s+"} if mark == " " else {"sep": mark}
    try:
        cells = pd.read_csv(
            io.StringIO(text), header=None, dtype=str, keep_default_na=False, skip_blank_lines=False, **options
        ).fillna("")
    except (ValueError, OSError) as error:  # pandas' own errors are ValueErrors
        raise UserError(str(path), _said(error, first - bool(names), mark)) from None
    cells.index += first + 1 - bool(names)
    return cells.iloc[1:] if names else cells


def _said(error: Exception, before: int, mark: str) -> str:
    """What pandas says, in words that need not be known from it, its lines counted as in the file."""
    reason = (str(error).strip().splitlines() or ["it is not text"])[0]
    if quote := re.search(r"EOF inside string starting at row (\d+)", reason):
        return f"cannot be read as CSV: a quote that begins in row {int(quote[1]) + 1 + before} does not end."
    ragged = re.search(r"Expected (\d+) fields in line (\d+), saw (\d+)", reason)
    if not ragged:
        return f"cannot be read as CSV: {reason}."
    expected, row, seen = (int(text) for text in ragged.groups())
    told = f"row {row + before} has {seen} cells, where {expected} {'is' if expected == 1 else 'are'} expected."
    if mark == "," and seen == 2 * expected:
        return f"{told} If these are decimal commas, put other delimiters between the cells, such as semicolons."
    if expected == 1:
        return f"{told} Where the cells are parted by another mark, say so with --delimiter."
    between = {" ": "a blank", "\t": "a tab"}.get(mark, f'"{mark}"')
    return f"{told} Take out what is too much; a cell that holds {between} needs quotes about it."


def _decimal(path: Path, cells: pd.DataFrame, layout: Layout, *, unquoted: bool) -> str:
    if layout.decimal or unquoted:
        return layout.decimal or "."
    marked = [
        (int(row), cell)
        for column in cells
        for row, cell in cells[column][cells[column].str.contains(",", regex=False)].items()
    ]
    if not marked:
        return "."
    everything = ((int(row), cell) for column in cells for row, cell in cells[column].items())
    try:
        return decimal_mark(everything)
    except Ambiguous as error:
        raise UserError(str(path), str(error)) from None


def _numbers(cells: Sequence[str], count: int) -> bool:
    """Whether these are the cells of a sample, as many as the header has, each a number."""
    return len(cells) == count > 1 and all(looks_like_a_number(cell) for cell in cells)

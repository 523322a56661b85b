"""Numbers in cells: decimal point or comma, what is missing, times of day; what is ambiguous is asked for."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array

MISSING = frozenset({"", "nan", "-nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---"})
NUMBER = re.compile(r"[-+−]?(\d[\d.,'’]*|[.,]\d+)([eEdD][-+]?\d+)?")
COMMA_GROUPS = re.compile(r"[-+−]?[1-9]\d{0,2}(,\d{3})+")
POINT_GROUPS = re.compile(r"[-+−]?[1-9]\d{0,2}(\.\d{3})+")
GROUPS = {",": re.compile(r"(?<=\d)[.'’](?=\d{3}(\D|$))"), ".": re.compile(r"(?<=\d)[,'’](?=\d{3}(\D|$))")}
"""What may stand between thousands, by the decimal mark."""
CLOCK = re.compile(r"(\d{1,3}):(\d\d)(?::(\d\d(?:[.,]\d+)?))?")
ISO = re.compile(r"\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d([.,]\d+)?)?)?(Z|[-+]\d\d:?\d\d)?")


class Ambiguous(ValueError):
    """A number can be read in two ways: the sentence says which, and which option decides."""


def looks_like_a_number(cell: str) -> bool:
    """Whether a cell is a number in any notation, missing, or a time of day."""
    text = cell.strip()
    return bool(
        text.lower() in MISSING or NUMBER.fullmatch(text) or CLOCK.fullmatch(text) or ISO.fullmatch(text)
    ) or math.isinf(number(text))


def is_missing(cell: object) -> bool:
    """Whether a cell says that there is no number."""
    return math.isnan(cell) if isinstance(cell, float) else str(cell).strip().lower() in MISSING


def number(cell: object, decimal: str = ".") -> float:
    """The number in a cell, NaN where there is none."""
    if not isinstance(cell, str):
        return float(cell) if isinstance(cell, (int, float, np.number)) else math.nan
    try:
        if "_" in cell:  # Python reads 1_0 as 10
            return math.nan
        if decimal == ".":
            return float(cell)
        if "." not in cell and cell.count(",") < 2:
            return float(cell.replace(",", "."))
    except ValueError:
        pass
    text = GROUPS[decimal].sub("", cell.strip()).replace("−", "-")
    if decimal == ",":
        if "." in text:
            return math.nan
        text = text.replace(",", ".")
    try:
        return float(re.sub(r"[dD](?=[-+]?\d+$)", "e", text))
    except ValueError:
        return math.nan


def decimal_mark(cells: Iterable[tuple[int, str]]) -> str:
    """The decimal mark of a file. cells : (row, text), all of them. Raises Ambiguous."""
    certain: dict[str, str] = {}
    doubtful: dict[str, str] = {}
    grouped = False
    for row, cell in cells:
        text = cell.strip()
        if not NUMBER.fullmatch(text) or not ("," in text or "." in text):
            continue
        said = f'row {row}: "{text}"'
        points, commas = text.count("."), text.count(",")
        if points and commas:
            certain.setdefault("," if text.rfind(",") > text.rfind(".") else ".", said)
            grouped = True
        elif commas > 1 or points > 1:
            certain.setdefault("." if commas else ",", said)
            grouped = True
        elif commas:
            (doubtful if COMMA_GROUPS.fullmatch(text) else certain).setdefault(",", said)
        else:
            (doubtful if POINT_GROUPS.fullmatch(text) else certain).setdefault(".", said)
    if len(certain) > 1:
        raise Ambiguous(f"{' beside '.join(certain.values())}: decimal comma and point in one file; give --decimal.")
    if not certain:
        if "," in doubtful:
            raise Ambiguous(
                f"{doubtful[',']} may be a decimal comma or thousands; give --decimal , or --decimal . to say which."
            )
        return "."
    ((mark, seen),) = certain.items()
    other = "." if mark == "," else ","
    if other in doubtful and not grouped:
        raise Ambiguous(
            f"{doubtful[other]} beside {seen} may be thousands or another decimal mark; give --decimal , or --decimal ."
        )
    return mark


def seconds(cells: pd.Series) -> Array | None:
    """Times of day or dates in ISO 8601 as seconds after the first, (samples,); None where a cell is neither."""
    texts = [str(cell).strip().replace(",", ".") for cell in cells]
    clocks = [CLOCK.fullmatch(text) for text in texts]
    if all(clocks):
        found = [3600 * int(c[1]) + 60 * int(c[2]) + float(c[3] or 0) for c in clocks if c]
        return np.array([round(one - found[0], 9) for one in found])
    if all(ISO.fullmatch(text) for text in texts):
        try:
            stamps = pd.to_datetime(pd.Series(texts), format="ISO8601", utc=True)
        except ValueError:
            return None
        return np.asarray((stamps - stamps.iloc[0]).dt.total_seconds(), dtype=float)
    return None

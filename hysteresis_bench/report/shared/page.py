"""Numbers as text, tables as data, and templates into one self-contained HTML page."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

NONE = "–"
NUMBER = re.compile(r"–|failed|not reached|(< )?-?[0-9][0-9.\u202f]*(×10[⁻⁰¹²³⁴-⁹]+)?(\u202f%| s)?( (to|of) .*)?")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Cell:
    """A table cell; `strong` where it is the one to look at.

    tone : classes of the style sheet: good, bad, quiet; code, prose (wide), line (never broken)
    """

    text: str
    tone: str = ""
    strong: bool = False


@dataclass(frozen=True)
class Table:
    """header : one a column; rows of text or Cell."""

    caption: str
    header: Sequence[str]
    rows: Sequence[Sequence[str | Cell]]
    note: str = ""

    @cached_property
    def cells(self) -> list[list[Cell]]:
        return [[cell if isinstance(cell, Cell) else Cell(cell) for cell in row] for row in self.rows]

    @cached_property
    def numeric(self) -> list[bool]:
        """Which columns hold nothing but numbers."""
        columns = zip(*self.cells, strict=True) if self.rows else ((Cell("a"),) for _ in self.header)
        return [all(re.fullmatch(NUMBER, cell.text) for cell in column) for column in columns]


def number(value: Any, digits: int = 4, never: str = "failed") -> str:
    """3.296×10⁻⁴, 0.0823, 15 050; NONE where absent, `never` where infinite."""
    if not _given(value):
        return NONE
    value = float(value)
    if math.isinf(value):
        return never
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e6:
        if value == round(value) and abs(value) >= 1:
            return whole(value)
        text = f"{value:.{digits}g}"
        return text if "e" not in text else whole(value)
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}×10{str(int(exponent)).translate(SUPERSCRIPTS)}"


def whole(value: Any, never: str = "not reached") -> str:
    """15 050 with narrow no-break spaces."""
    if not _given(value):
        return NONE
    if math.isinf(float(value)):
        return never
    return f"{round(float(value)):,}".replace(",", "\u202f")


def percent(value: Any, digits: int = 3, never: str = "failed") -> str:
    """0.0807 -> 8.07 %."""
    if not _given(value):
        return NONE
    return never if math.isinf(float(value)) else f"{number(100.0 * float(value), digits)}\u202f%"


def probability(p: Any) -> str:
    """0.023, or < 0.001; NONE below enough trials."""
    if not _given(p):
        return NONE
    return "< 0.001" if float(p) < 0.001 else f"{float(p):.3f}"


def share(value: Any) -> str:
    """An A12 with two decimals."""
    return f"{float(value):.2f}" if _given(value) else NONE


def seconds(value: Any) -> str:
    return NONE if not _given(value) or math.isinf(float(value)) else f"{float(value):.2g} s"


def listed(names: Sequence[str], most: int = 6) -> str:
    """a, b and c; a long list is cut and counted."""
    shown = list(names[:most])
    if len(names) > most:
        shown.append(f"{len(names) - most} more")
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}" if shown else "none"


def _given(value: Any) -> bool:
    import pandas as pd

    return value is not None and not pd.isna(value)


@cache
def _environment() -> Any:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("hysteresis_bench.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def render(template: str, **context: Any) -> str:
    """A page with the style inside it; every text is escaped, figures excepted."""
    style = (files("hysteresis_bench.report") / "templates" / "style.css").read_text(encoding="utf-8")
    return _environment().get_template(template).render(style=style, **context)

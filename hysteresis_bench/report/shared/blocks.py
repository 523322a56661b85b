"""What a section of a page is made of. A plain string is a paragraph; a `Markup` is one that holds links."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from hysteresis_bench.report.shared.text import listed, number, percent, unit_cell
from hysteresis_bench.report.shared.theme import Picture

NUMBER = re.compile(
    r"–|failed|not reached|not determined|(< )?-?[0-9][0-9.\u202f]*(×10[⁻⁰¹²³⁴-⁹]+)?(\u202f%| s)?( (to |of |± |\().*)?"
)

SIDE_BY_SIDE = 16
"""Columns of a table that still fit a page with their names written across."""


@dataclass(frozen=True)
class Cell:
    """A table cell; `strong` where it is the one to look at.

    tone : classes of the style sheet: good, bad, quiet; code, prose (wide), line (never broken)
    link : where its text leads, such as #ANCHOR;  anchor : of its row, unique in the page
    """

    text: str
    tone: str = ""
    strong: bool = False
    link: str = ""
    anchor: str = ""


@dataclass(frozen=True)
class Table:
    """header : one a column; rows of text or Cell."""

    kind: ClassVar[str] = "table"

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

    @property
    def many(self) -> bool:
        """Whether its columns have no room for their names beside each other, which then run downwards."""
        return len(self.header) > SIDE_BY_SIDE


@dataclass(frozen=True)
class Paragraph:
    """style : a class of the style sheet, such as strong, note, source, code."""

    kind: ClassVar[str] = "paragraph"

    text: str
    style: str


@dataclass(frozen=True)
class Heading:
    """Of a part of a section."""

    kind: ClassVar[str] = "heading"

    text: str


@dataclass(frozen=True)
class Bullets:
    """An unordered list."""

    kind: ClassVar[str] = "bullets"

    items: Sequence[str]


@dataclass(frozen=True)
class Terms:
    """What is called so, and what it is."""

    kind: ClassVar[str] = "terms"

    pairs: Sequence[tuple[str, str]]


@dataclass(frozen=True)
class Figures:
    """Side by side where there is room. size : small, large, or between the two."""

    kind: ClassVar[str] = "figures"

    pictures: Sequence[Picture]
    size: str = ""


@dataclass(frozen=True)
class Details:
    """Folded away behind its summary."""

    kind: ClassVar[str] = "details"

    summary: str
    blocks: Sequence[Block]


def inside(blocks: Sequence[Block]) -> str:
    """What a reader finds behind a line that opens it, counted: `2 tables and 12 figures`; `the text` without any."""
    counted = [f"{count} {what}{'s' * (count > 1)}" for what, count in _counted(blocks).items() if count]
    return listed(counted) if counted else "the text"


def _counted(blocks: Sequence[Block]) -> Counter[str]:
    """Tables, figures and terms, however deep."""
    found = Counter({"table": 0, "figure": 0, "term": 0})  # in this order
    for block in blocks:
        if isinstance(block, Table):
            found["table"] += 1
        elif isinstance(block, Figures):
            found["figure"] += len(block.pictures)
        elif isinstance(block, Terms):
            found["term"] += len(block.pairs)
        elif isinstance(block, Details):
            found.update(_counted(block.blocks))
    return found


Block = str | Table | Paragraph | Heading | Bullets | Terms | Figures | Details


def estimate_cells(
    name: str, value: float, error: float | None, *, unit: str | None, digits: int = 4
) -> list[str | Cell]:
    """The cells of a fitted parameter: name, value, standard error, that as a share of the value, unit.

    error : None or infinite where the data cannot tell
    digits : significant ones of the value; model.json holds all
    """
    share = abs(error / value) if error is not None and value else None
    unsure = share is not None and share > 1.0
    unknown = "not determined"
    return [
        name,
        number(value, digits),
        unknown if error is None else number(error, 2, never=unknown),
        Cell(percent(share, 2, never=unknown), "bad" if unsure else ""),
        unit_cell(unit),
    ]


ESTIMATE_HEADER = ("Parameter", "Value", "Standard error", "Of the value", "Unit")
ESTIMATE_NOTE = "Standard errors allow for correlated residuals; they do not know of what the model lacks."

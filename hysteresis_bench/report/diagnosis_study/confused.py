"""What was hidden beside what was claimed for it: the figure, and the same as a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from hysteresis_bench.diagnosis_study.case import Case
from hysteresis_bench.diagnosis_study.confusion import BESIDE, NOTHING, confusion
from hysteresis_bench.report.diagnosis_study.figures import RIGHT, confusion_matrix, shown
from hysteresis_bench.report.shared.blocks import Block, Cell, Figures, Heading, Table
from hysteresis_bench.report.shared.text import listed, whole

LAST = (BESIDE, NOTHING)
"""What stands below the effects, and beside them."""

Counts = Mapping[tuple[str, str], int]
"""Cases by what was hidden and what was claimed for it."""


def confusion_blocks(folder: Path, name: str, heading: str, cases: Sequence[Case]) -> list[Block]:
    """Heading, what was always claimed rightly, and figure and table of the rest; nothing without a case that is done.

    name : of the figure's file, after "confusion-"
    """
    counts = counted(cases)
    if not counts:
        return []
    mistaken = {pair: count for pair, count in counts.items() if pair[1] != RIGHT}
    rows = _ordered({row for row, _ in mistaken})
    blocks: list[Block] = [Heading(heading)]
    if sound := [row for row in _ordered({row for row, _ in counts}) if row not in rows]:
        told = [
            f"{f'{NOTHING}, where nothing was hidden' if row == NOTHING else shown(row)} ({whole(counts[row, RIGHT])})"
            for row in sound
        ]
        blocks.append(f"Always claimed rightly, in so many cases: {listed(told, len(told))}.")
    if not mistaken:
        return blocks
    columns = [RIGHT, *_ordered({column for _, column in mistaken})]
    some = {pair: count for pair, count in counts.items() if pair[0] in rows}
    drawn = confusion_matrix(folder, f"confusion-{name}", some, rows=rows, columns=columns)
    return [*blocks, Figures([drawn]), _table(mistaken, cases)]


def counted(cases: Sequence[Case]) -> dict[tuple[str, str], int]:
    """Cases by what was hidden and what was claimed for it: RIGHT where that is one of its names."""
    table = confusion(cases)
    counts: dict[tuple[str, str], int] = {}
    for row in table.index:
        for column in table.columns:
            if count := int(table.at[row, column]):
                claimed = RIGHT if column in row.split("|") else column
                counts[row, claimed] = counts.get((row, claimed), 0) + count
    return counts


def _ordered(names: set[str]) -> list[str]:
    return sorted(names, key=lambda name: (name in LAST, name))


def _table(mistaken: Counts, cases: Sequence[Case]) -> Table:
    """A row a mistake, the most frequent first."""
    rows: list[list[str | Cell]] = [
        [shown(row), claimed, Cell(f"{whole(count)} of {whole(_asked(row, cases))}", "bad")]
        for (row, claimed), count in sorted(mistaken.items(), key=lambda each: (-each[1], each[0]))
    ]
    note = (
        "Of the cases with it hidden. An effect that was missed stands under what was claimed in its place, a tied one "
        f"and the curve of its family included, or under {NOTHING}. {BESIDE.capitalize()}: claims too many in cases "
        f"with something hidden of which nothing was missed. Hidden {NOTHING}: cases with nothing hidden."
    )
    return Table("What was claimed in its place", ["Hidden", "Claimed", "Cases"], rows, note)


def _asked(row: str, cases: Sequence[Case]) -> int:
    """Finished cases with it hidden; for the last rows those with anything, and with nothing."""
    hidden = [case.hidden.split() for case in cases if case.status == "done"]
    if row in LAST:
        return sum(bool(names) == (row == BESIDE) for names in hidden)
    return sum(row in names for names in hidden)

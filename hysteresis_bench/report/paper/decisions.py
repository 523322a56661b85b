"""What a paper leaves open, and what was decided here."""

from __future__ import annotations

from collections.abc import Sequence

from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Table
from hysteresis_bench.report.shared.page import Section


def section(published: Published, notes: Sequence[str]) -> Section | None:
    """notes : of the study file;  None where nothing was left open."""
    blocks: list[Block] = []
    if published.decision:
        rows: list[list[str | Cell]] = [
            [each.where, Cell(each.open, "prose"), Cell(each.decided, "prose")] for each in published.decision
        ]
        blocks.append(Table("Decisions", ["Where", "Left open", "Decided"], rows))
    if notes:
        blocks.append(Bullets(notes))
    return Section("decisions", "What was left open, and decided", blocks) if blocks else None

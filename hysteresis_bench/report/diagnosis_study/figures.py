"""The confusion matrix and the reliability diagram of a study of diagnosis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hysteresis_bench.report.diagnosis.figures import AFTER, BEFORE
from hysteresis_bench.report.diagnosis_study.reliability import Bin
from hysteresis_bench.report.shared.theme import MUTED, Picture, picture
from hysteresis_bench.statistics import wilson

RIGHT = "right name"
"""The column of what was claimed by one of its names, or of nothing where nothing was hidden."""

FONT = 11.0
"""Points: of names and counts, as a wide figure is drawn smaller where there is little room."""


def shown(hidden: str) -> str:
    """a|b, where either name says it, as "a or b"."""
    return hidden.replace("|", " or ")


def confusion_matrix(
    folder: Path, name: str, counts: Mapping[tuple[str, str], int], *, rows: Sequence[str], columns: Sequence[str]
) -> Picture:
    """How often each hidden effect (row) was claimed as each effect (column, RIGHT for its own)."""

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        whole = {row: sum(count for (own, _), count in counts.items() if own == row) for row in rows}
        for (row, column), count in counts.items():
            at = columns.index(column), rows.index(row)
            colour = AFTER if column == RIGHT else BEFORE
            axes.scatter(*at, s=420 * count / whole[row], color=colour, alpha=0.35, linewidth=0, zorder=2)
            axes.annotate(str(count), at, ha="center", va="center", fontsize=FONT, zorder=3)
        axes.set_xticks(range(len(columns)), columns, rotation=45, ha="right", rotation_mode="anchor")
        axes.set_yticks(range(len(rows)), [shown(row) for row in rows])
        axes.tick_params(labelsize=FONT)
        axes.set(xlim=(-0.6, len(columns) - 0.4), ylim=(len(rows) - 0.4, -0.6))
        axes.set_xlabel("Claimed", fontsize=FONT)
        axes.set_ylabel("Hidden", fontsize=FONT)

    size = (2.4 + 0.36 * len(columns), 2.2 + 0.34 * len(rows))
    caption = (
        "Hidden against claimed, in cases, of what was not always claimed rightly. Blue: the right name. Orange: "
        "another one, tied ones and the curve of a family included. Area: the share of its row."
    )
    return picture(folder, name, size, alt="Confusion matrix; the table has the numbers.", caption=caption, draw=draw)


def reliability_diagram(folder: Path, bins: Sequence[Bin]) -> Picture:
    """The share of right claims over the probability that was told, with Wilson's intervals."""

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot([0, 1], [0, 1], color=MUTED, linewidth=0.8, zorder=1)
        for one in bins:
            low, high = wilson(one.right, one.claims)
            axes.plot([one.told, one.told], [low, high], color=AFTER, linewidth=1.4, zorder=2)
            axes.scatter(one.told, one.right / one.claims, s=26, color=AFTER, linewidth=0, zorder=3)
        lowest = min([0.8, *(min(one.told, wilson(one.right, one.claims)[0]) for one in bins)])
        axes.set(
            xlim=(lowest - 0.02, 1.02),
            ylim=(lowest - 0.02, 1.02),
            xlabel="Probability told",
            ylabel="Share of right claims",
        )

    caption = (
        "Claims in bins of the probability told with them; bars: 95 % intervals. On the line as many were right as was "
        "told, above it more."
    )
    return picture(
        folder, "reliability", (3.4, 3.2), alt=f"{caption} The table has the numbers.", caption=caption, draw=draw
    )

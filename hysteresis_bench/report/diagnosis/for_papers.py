"""The figure of a diagnosis for a paper: the error step by step, and a record before and after."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hysteresis_bench.diagnosis.findings.diagnosis_file import read_diagnosis
from hysteresis_bench.report.diagnosis.before_after import bars_from
from hysteresis_bench.report.diagnosis.figures import draw_loop, draw_residual, draw_waterfall, stages
from hysteresis_bench.report.shared.papers import save_figure

BELOW = 4.4
"""Inches: height of loop and residual."""


def draw_diagnosis(path: Path, folder: Path) -> None:
    """The waterfall, then loop and residual of the first held-out record, of the first fitted one where there is none.

    folder : with the files of a diagnosis.  Raises UserError where it holds none.
    """
    kept = read_diagnosis(folder)
    found, units = kept.diagnosis, kept.model["units"]
    steps = bars_from(found)
    records = [rows for _, rows in kept.responses.groupby("record", sort=False)]
    rows = next((rows for rows in records if rows["role"].iloc[0] == "held-out"), records[0])
    bars = 0.6 + 0.3 * len(steps)

    def draw(figure: Any) -> None:
        above, below = figure.subfigures(2, 1, height_ratios=(bars, BELOW))  # each with margins of its own
        upper, (loop, residual) = above.subplots(), below.subplots(2, 1, height_ratios=(2, 1))
        draw_waterfall(upper, steps, units)
        upper.set_yticks(
            [tick - 0.46 for tick in upper.get_yticks()],  # above the bars, which a column leaves no room beside
            [label.get_text() for label in upper.get_yticklabels()],
            ha="left",
            fontsize=7,
        )
        upper.tick_params(axis="y", length=0, pad=-3)
        upper.set_ylim(len(steps) - 0.6, -0.8)
        draw_loop(loop, rows, stages(rows), units)
        draw_residual(residual, rows, "time", found["floor"], units)
        loop.set_title(f"{rows['record'].iloc[0]} ({rows['role'].iloc[0]})")
        loop.legend()
        residual.set_title("Simulated minus measured")
        below.align_ylabels()

    save_figure(path, bars + BELOW, draw)

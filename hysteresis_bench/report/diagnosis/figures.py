"""Figures of a diagnosis: the error from bare model to noise, loops and residuals before and after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.report.shared.page import number
from hysteresis_bench.report.shared.signal_figures import Units, named
from hysteresis_bench.report.shared.theme import GRID, INK, MUTED, SERIES, Picture, picture

BEFORE, AFTER, NOISE, HELD_OUT = SERIES[1], SERIES[0], SERIES[2], SERIES[3]
MOST = 3000
"""Points of a curve in a figure; more only make the page heavy."""


def waterfall(
    folder: Path,
    steps: Sequence[tuple[str, float]],
    held_out: tuple[float | None, float | None],
    units: Units,
    name: str = "waterfall",
) -> Picture:
    """From the bare model via each adopted effect to the noise.

    steps : label and RMSE on the fitted records, the noise last;  held_out : RMSE before and after, on what was
    not fitted
    """
    labels = [steps[0][0], *(f"+ {label}" for label, _ in steps[1:-1]), "noise in the data"]
    values = [value for _, value in steps]
    last = len(steps) - 2

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for row, value in enumerate(values):
            colour = NOISE if row > last else BEFORE if row == 0 else AFTER
            axes.barh(row, value, height=0.55, color=colour, zorder=3)
            if 0 < row <= last:
                gain = values[row - 1] - value
                axes.barh(row, gain, left=value, height=0.55, color=GRID, edgecolor=MUTED, linewidth=0.6, zorder=2)
        axes.axvline(values[-1], color=NOISE, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
        for row, error in ((0, held_out[0]), (last, held_out[1])):
            if error is not None:
                axes.plot(error, row, "D", color=HELD_OUT, markersize=6, zorder=4, clip_on=False)
        columns: list[tuple[float, str, str, dict[int, float | None]]] = [
            (1.02, "fitted", INK, dict(enumerate(values)))
        ]
        if any(value is not None for value in held_out):
            columns.append((1.19, "not fitted", HELD_OUT, {0: held_out[0], last: held_out[1]}))
        beside = axes.get_yaxis_transform()  # x as a share of the axes, y in rows
        for place, heading, colour, told_here in columns:
            axes.text(place, -0.7, heading, color=colour, transform=beside, va="center", fontsize=8)
            for row, told_value in told_here.items():
                axes.text(place, row, number(told_value, 3), color=colour, transform=beside, va="center")
        axes.set_yticks(range(len(labels)), labels)
        axes.invert_yaxis()
        axes.grid(axis="y", visible=False)
        axes.set_xlim(0, 1.03 * max(values + [value for value in held_out if value is not None]))
        axes.ticklabel_format(axis="x", scilimits=(-3, 5), useMathText=True)
        axes.set_xlabel(named("RMSE", units, "output"))

    told = ", ".join(f"{label} {value:.3g}" for label, value in zip(labels, values, strict=True))
    caption = (
        "Error on the fitted records, bare model first, each bar with the effects above it; grey is what the effect "
        "takes away. Diamonds: error on what was not fitted, bare and final."
    )
    height = 1.25 + 0.36 * len(steps)
    return picture(folder, name, (6.4, height), f"RMSE step by step: {told}.", caption, draw)


def loops(folder: Path, name: str, rows: pd.DataFrame, units: Units, caption: str) -> Picture:
    """Output over input of one record, measured, before and after side by side."""
    rows = fewer(rows)

    def draw(figure: Any) -> None:
        for axes, which, colour in zip(
            figure.subplots(1, 2, sharex=True, sharey=True), ("before", "after"), (BEFORE, AFTER), strict=True
        ):
            axes.plot(rows["input"], rows["output"], color=MUTED, linewidth=2.6, alpha=0.5, label="measured")
            axes.plot(rows["input"], rows[which], color=colour, linewidth=1.1, label=which)
            axes.set_xlabel(named("Input", units, "input"))
            axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=2, borderaxespad=0, handlelength=1.4)
        figure.axes[0].set_ylabel(named("Output", units, "output"))

    return picture(folder, name, (6.0, 3.0), f"Loop before and after. {caption}", caption, draw)


def residuals(folder: Path, name: str, rows: pd.DataFrame, noise: float, units: Units, caption: str) -> Picture:
    """Measured minus simulated of one record, over time and over input, before and after; noise : RMS, shaded."""
    rows = fewer(rows)

    def draw(figure: Any) -> None:
        panels = figure.subplots(1, 2, sharey=True, width_ratios=(1.7, 1))
        for axes, along, label in zip(panels, ("time", "input"), ("Time", "Input"), strict=True):
            axes.axhspan(-2 * noise, 2 * noise, color=GRID, alpha=0.7, linewidth=0)
            axes.axhline(0, color=INK, linewidth=0.6)
            for which, colour in (("before", BEFORE), ("after", AFTER)):
                axes.plot(rows[along], rows["output"] - rows[which], color=colour, linewidth=0.8, label=which)
            axes.set_xlabel(named(label, units, along))
            axes.locator_params(axis="x", nbins=5)
        panels[0].set_ylabel(named("Residual", units, "output"))
        panels[0].legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=2, borderaxespad=0, handlelength=1.4)

    told = f"{caption} Shaded: twice the noise to either side."
    return picture(folder, name, (6.4, 2.6), f"Residual before and after. {caption}", told, draw)


def confusion(
    folder: Path, name: str, counts: Mapping[tuple[str, str], int], rows: Sequence[str], columns: Sequence[str]
) -> Picture:
    """How often each hidden effect (row) was claimed as each effect (column)."""

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        largest = max(counts.values(), default=1)
        for (row, column), count in counts.items():
            at = columns.index(column), rows.index(row)
            right = column in row.split("|")
            colour = AFTER if right else BEFORE
            axes.scatter(*at, s=330 * count / largest, color=colour, alpha=0.35, linewidth=0, zorder=2)
            axes.annotate(str(count), at, ha="center", va="center", zorder=3)
        axes.set_xticks(range(len(columns)), columns, rotation=45, ha="right", rotation_mode="anchor")
        axes.set_yticks(range(len(rows)), rows)
        axes.set(xlim=(-0.6, len(columns) - 0.4), ylim=(len(rows) - 0.4, -0.6), xlabel="Claimed", ylabel="Hidden")

    size = (1.9 + 0.36 * len(columns), 1.6 + 0.32 * len(rows))
    caption = "Hidden against claimed, in cases. Blue: the right name. Orange: another name, tied ones included."
    return picture(folder, name, size, "Confusion matrix; the table has the numbers.", caption, draw)


def fewer(rows: pd.DataFrame) -> pd.DataFrame:
    """Evenly spread rows, at most MOST."""
    return rows.iloc[np.unique(np.linspace(0, len(rows) - 1, min(len(rows), MOST)).astype(int))]

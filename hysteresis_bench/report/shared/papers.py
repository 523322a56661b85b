"""Figures for papers: PDF, SVG or PNG, one column wide, with the units on the axes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.unseen.interval import HIGH
from hysteresis_bench.report.shared.text import Units, named
from hysteresis_bench.report.shared.theme import INK, MUTED, SERIES, STYLE, legend
from hysteresis_bench.signals import Dataset

COLUMN = 3.4
"""Inches: one column of a journal's page."""
KINDS = (".pdf", ".svg", ".png")
MOST = 6
"""Records in one figure."""


def check_figure(path: Path) -> None:
    """Raises UserError for a figure of a kind that cannot be drawn."""
    if path.suffix.lower() not in KINDS:
        raise UserError(str(path), f"a figure is one of {', '.join(KINDS)}.")


def draw_records(path: Path, dataset: Dataset) -> None:
    """Input and output over time, and the loops, of the first records."""

    def draw(figure: Any) -> None:
        upper, middle, loop = figure.subplots(3, 1, height_ratios=(1, 1, 2))
        for record, colour in zip(dataset.records[:MOST], SERIES, strict=False):
            upper.plot(record.time, record.input, color=colour)
            if record.output is not None:
                middle.plot(record.time, record.output, color=colour)
                loop.plot(record.input, record.output, color=colour, label=record.name)
        _label(upper, dataset.units, "", "input")
        _label(middle, dataset.units, "time", "output")
        _label(loop, dataset.units, "input", "output")
        loop.legend(frameon=False)

    _save(path, 5.6, draw)


def draw_prediction(path: Path, measured: Dataset, predicted: Dataset) -> None:
    """Measured and predicted loops, the error over time, and the interval about it, of the first records."""
    pairs = list(zip(measured.records, predicted.records, strict=True))[:MOST]

    def draw(figure: Any) -> None:
        loop, error = figure.subplots(2, 1, height_ratios=(2, 1))
        for (known, made), colour in zip(pairs, SERIES, strict=False):
            if known.output is not None:
                loop.plot(known.input, known.output, color=MUTED, linewidth=2.2, alpha=0.5)
                error.plot(known.time, np.asarray(made.output) - known.output, color=colour, linewidth=1.0)
            loop.plot(known.input, made.output, color=colour, linewidth=1.0, label=made.name)
        loop.set_title("measured (grey) and predicted")
        error.set_title("predicted minus measured")
        made = pairs[0][1]
        if HIGH in made.columns:  # as far from the prediction everywhere
            half = float(made.columns[HIGH][0] - np.asarray(made.output)[0])
            error.set_title("predicted minus measured, and the interval")
            for edge in (-half, half):
                error.axhline(edge, color=INK, linewidth=1.0, linestyle="--", zorder=3)
        _label(loop, predicted.units, "input", "output")
        _label(error, predicted.units, "time", "output")
        loop.legend(frameon=False)

    _save(path, 4.6, draw)


def draw_tracking(path: Path, columns: dict[str, Array], units: Units) -> None:
    """Wanted and reached output, the input that does it, and what is left.

    columns : time, input, wanted, reached, (samples,) each
    """

    def draw(figure: Any) -> None:
        track, drive, error = figure.subplots(3, 1, sharex=True, height_ratios=(2, 1, 1))
        track.plot(columns["time"], columns["wanted"], color=MUTED, linewidth=2.2, alpha=0.5, label="wanted")
        track.plot(columns["time"], columns["reached"], color=SERIES[0], linewidth=1.0, label="the model's answer")
        drive.plot(columns["time"], columns["input"], color=INK, linewidth=1.0)
        error.plot(columns["time"], columns["reached"] - columns["wanted"], color=SERIES[1], linewidth=1.0)
        _label(track, units, "", "output")
        _label(drive, units, "", "input")
        _label(error, units, "time", "output", "error")
        legend(track)

    _save(path, 4.6, draw)


def draw_sweep(path: Path, table: pd.DataFrame, units: Units) -> None:
    """Expected error over frequency, a line an amplitude; table : as `sweep` makes it"""

    def draw(figure: Any) -> None:
        axes = figure.subplots()
        for place, (amplitude, rows) in enumerate(table.dropna(subset="expected").groupby("amplitude")):
            colour, share = SERIES[place % len(SERIES)], 100.0 / rows["amplitude"]
            unit = "" if units["output"] == "1" else f" {units['output']}"
            label = f"amplitude {amplitude:.3g}{unit}"
            axes.plot(rows["frequency"], share * rows["expected"], color=colour, marker="o", markersize=3, label=label)
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter("{x:g}")
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel(f"Frequency (1/{units['time']})")
        axes.set_ylabel("Expected RMS error (% of amplitude)")
        legend(axes)

    _save(path, 2.8, draw)


def _label(axes: Any, units: Units, x: str, y: str, said: str = "") -> None:
    if x:
        axes.set_xlabel(named(x.capitalize(), units, x))
    axes.set_ylabel(named((said or y).capitalize(), units, y))


def _save(path: Path, height: float, draw: Callable[[Any], None]) -> None:
    import matplotlib
    from matplotlib.figure import Figure

    metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(path.suffix.lower(), {})
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": path.stem, "figure.facecolor": "white"}):
        figure = Figure(figsize=(COLUMN, height))
        draw(figure)
        figure.savefig(path, dpi=300, metadata=metadata)

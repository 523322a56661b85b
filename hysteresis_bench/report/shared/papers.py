"""Figures for papers: PDF, SVG or PNG, one column wide, with the units on the axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

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
RECORDS_DRAWN = 6
"""Records in one figure."""
LOOP, STRIP = 2.8, 1.2
"""Inches: heights of a loop, and of an error over time."""


class Part(NamedTuple):
    """A record and what a model makes of it, (samples,) each; measured : None where no output was."""

    name: str
    time: Array
    input: Array
    measured: Array | None
    made: Array


def check_figure(path: Path) -> None:
    """Raises UserError for a figure of a kind that cannot be drawn."""
    if path.suffix.lower() not in KINDS:
        raise UserError(str(path), f"a figure is one of {', '.join(KINDS)}.")


def draw_records(path: Path, dataset: Dataset) -> None:
    """Input and output over time, and the loops, of the first records."""

    def draw(figure: Any) -> None:
        upper, middle, loop = figure.subplots(3, 1, height_ratios=(1, 1, 2))
        for record, colour in zip(dataset.records[:RECORDS_DRAWN], SERIES, strict=False):
            upper.plot(record.time, record.input, color=colour)
            if record.output is not None:
                middle.plot(record.time, record.output, color=colour)
                loop.plot(record.input, record.output, color=colour, label=record.name)
        _label(upper, dataset.units, "", "input")
        _label(middle, dataset.units, "time", "output")
        _label(loop, dataset.units, "input", "output")
        loop.legend(frameon=False)

    save_figure(path, 5.6, draw)


def draw_prediction(path: Path, measured: Dataset, predicted: Dataset) -> None:
    """Measured and predicted loops, the error over time, and the interval about it, of the first records."""
    pairs = list(zip(measured.records, predicted.records, strict=True))
    parts = [Part(made.name, made.time, known.input, known.output, np.asarray(made.output)) for known, made in pairs]
    made, half = pairs[0][1], None
    if HIGH in made.columns:  # as far from the prediction everywhere
        half = float(made.columns[HIGH][0] - np.asarray(made.output)[0])
    _draw_followed(path, parts, predicted.units, "predicted", half)


def draw_fit(path: Path, responses: pd.DataFrame, units: Units) -> None:
    """Measured and fitted loops, and the error over time, of the first records.

    responses : record, role, time, input, output, simulated
    """
    parts = []
    for (record, role), rows in responses.groupby(["record", "role"], sort=False):
        name = str(record) if role == "fitted" else f"{record} (held out)"
        parts.append(Part(name, *(rows[column].to_numpy(float) for column in ("time", "input", "output", "simulated"))))
    _draw_followed(path, parts, units, "fitted")


def _draw_followed(path: Path, parts: Sequence[Part], units: Units, word: str, half: float | None = None) -> None:
    """Loops above, the error of each record that was measured below; half : of the interval's width"""
    shown = parts[:RECORDS_DRAWN]
    known = [index for index, part in enumerate(shown) if part.measured is not None]
    strip_height = STRIP if len(known) < 3 else 0.7 * STRIP

    def draw(figure: Any) -> None:
        heights = [LOOP, *[strip_height] * len(known)]
        loop, *strips = figure.subplots(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
        for part, colour in zip(shown, SERIES, strict=False):
            if part.measured is not None:
                loop.plot(part.input, part.measured, color=MUTED, linewidth=2.2, alpha=0.5)
            loop.plot(part.input, part.made, color=colour, linewidth=1.0, label=part.name)
        loop.set_title(f"Measured (grey) and {word}" if known else word.capitalize())
        _label(loop, units, "input", "output")
        loop.legend(frameon=False)
        for strip, index in zip(strips, known, strict=True):
            part = shown[index]
            strip.plot(part.time, part.made - part.measured, color=SERIES[index], linewidth=0.8)
            for edge in () if half is None else (-half, half):
                strip.axhline(edge, color=INK, linewidth=1.0, linestyle="--", zorder=3)
            strip.sharey(strips[0])
            _label(strip, units, "", "output", "error")
        if strips:
            minus = f"{word.capitalize()} minus measured"
            strips[0].set_title(minus if half is None else "Error, and the interval (dashed)")
            _label(strips[-1], units, "time", "output", "error")
        figure.align_ylabels()

    save_figure(path, 1.1 * (LOOP + strip_height * len(known)), draw)


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

    save_figure(path, 4.6, draw)


def draw_sweep(path: Path, table: pd.DataFrame, units: Units) -> None:
    """Expected error over frequency, a line an amplitude, its marks hollow where the fit has not seen the like.

    table : as `sweep` makes it
    """

    def draw(figure: Any) -> None:
        axes = figure.subplots()
        for place, (amplitude, rows) in enumerate(table.dropna(subset="expected").groupby("amplitude")):
            colour, share = SERIES[place % len(SERIES)], 100.0 / rows["amplitude"]
            errors, label = share * rows["expected"], f"{amplitude:.3g}"
            axes.plot(rows["frequency"], errors, color=colour, marker="o", markersize=3, label=label)
            guessed = rows["beyond"] != ""
            axes.plot(rows["frequency"][guessed], errors[guessed], "o", color=colour, markersize=3, markerfacecolor="w")
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter("{x:g}")
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel(f"Frequency (1/{units['time']})")
        axes.set_ylabel("Expected RMS error\n(% of amplitude)")
        hollow = "; hollow: unlike the fit" if (table["beyond"].fillna("") != "").any() else ""
        title = f"{named('Amplitude', units, 'output')}{hollow}"
        figure.legend(loc="outside upper left", ncols=4, handlelength=1.4, title=title, alignment="left")

    save_figure(path, 2.9, draw)


def _label(axes: Any, units: Units, x: str, y: str, said: str = "") -> None:
    if x:
        axes.set_xlabel(named(x.capitalize(), units, x))
    axes.set_ylabel(named((said or y).capitalize(), units, y))


def save_figure(path: Path, height: float, draw: Callable[[Any], None]) -> None:
    """Draw on a figure of one column and that height in inches; the same numbers make the same file."""
    import matplotlib
    from matplotlib.figure import Figure

    from hysteresis_bench.report.shared.log_labels import in_plain_powers

    metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(path.suffix.lower(), {})
    own = {"axes.formatter.use_mathtext": True, "svg.hashsalt": path.stem, "figure.facecolor": "white"}
    own = {"svg.hashsalt": path.stem, "figure.facecolor": "white", "axes.formatter.use_mathtext": True}
    with matplotlib.rc_context(STYLE | own):
        figure = Figure(figsize=(COLUMN, height))
        draw(figure)
        in_plain_powers(figure)
        figure.savefig(path, dpi=300, metadata=metadata)

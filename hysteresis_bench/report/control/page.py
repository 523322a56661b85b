"""The page of a control comparison: who follows best, at what chatter, beside the floor."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from hysteresis_bench.control.bench import FEED_FORWARD, MEANINGS, PI, SLIDING
from hysteresis_bench.control.comparison import Comparison
from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.report.shared.blocks import Bullets, Cell, Figures, Table, Terms
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.shared.text import Units, listed, named, number, percent
from hysteresis_bench.report.shared.theme import INK, MUTED, SERIES, Picture, legend, picture

if TYPE_CHECKING:
    from rich.console import Console

PAGE, SCORES, RESPONSES = "control.html", "control.csv", "responses.csv"

COLOURS = (*SERIES, MUTED)
"""Of the controllers, in their order."""

FLOORS = ("Sensor noise, RMS", "One sample late, RMS")

Parts = Mapping[str, pd.DataFrame]
"""Controller -> its run along one reference."""


def write_control(folder: Path, comparison: Comparison, model: str) -> Path:
    """Write control.csv, responses.csv, figures and control.html into the folder; returns the page.

    model : what the model is called, for the title
    """
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / SCORES, comparison.scores, digits=6)
    write_table(folder / RESPONSES, comparison.responses, digits=6)
    conditions, volts = comparison.conditions, comparison.units["input"]
    errors = [_table(comparison, score) for score in ("t_rmse", "t_error")]
    meanings = [(name, MEANINGS[name]) for name in _names(comparison.scores)]
    sections = [
        Section("errors", "Tracking errors", [*errors, Terms(meanings)]),
        Section("tracking", "References and errors", [Figures(_pictures(folder, comparison))]),
        Section("effort", "Chatter and saturation", [_effort(comparison)]),
        Section("settings", "Tuning", [_settings(comparison)]),
        Section("notes", "How it was made", [Bullets(comparison.notes), Terms(_facts(comparison))]),
    ]
    page = Page(
        f"{model} in control of the rig {conditions['rig']}",
        f"{conditions['rate']:g} samples a second, input within ±{conditions['voltage_limit']:g} {volts}",
        sections,
        answer(comparison.scores),
        answers="Who follows best",
        warnings=comparison.warnings,
    )
    return page.write(folder / PAGE)


def print_control(comparison: Comparison, console: Console) -> None:
    """The warnings, T_rmse of every controller on every reference, the answer."""
    from rich.markup import escape
    from rich.table import Table as Terminal

    for warning in comparison.warnings:
        console.print(f"[yellow]note:[/] {escape(warning)}", highlight=False)
    scores = comparison.scores
    errors = scores.pivot(index="controller", columns="reference", values="t_rmse")
    references = list(dict.fromkeys(scores["reference"]))
    unit = scores["unit"].iloc[0]
    table = Terminal(
        title=escape(f"T_rmse [{unit}]"), title_justify="left", box=None, title_style="bold", pad_edge=False
    )
    table.add_column("controller", no_wrap=True)
    for reference in references:
        table.add_column(reference.replace("-", " "), justify="right")
    for controller in _names(scores):
        cells = [
            f"[bold]{value:.3g}[/]" if value == best else f"{value:.3g}"
            for value, best in zip(errors.loc[controller, references], errors[references].min(), strict=True)
        ]
        table.add_row(controller, *cells)
    table.add_row("sensor noise", *[f"{scores['noise_floor'].iloc[0]:.3g}"] * len(references), style="dim")
    console.print(table)
    for sentence in answer(scores):
        console.print(sentence, highlight=False)


def answer(scores: pd.DataFrame) -> list[str]:
    """Who follows best, whether the compound controllers beat the feed-forward everywhere, and at what chatter."""
    errors = scores.pivot_table(index="reference", columns="controller", values="t_rmse", sort=False)
    variation = scores.pivot(index="reference", columns="controller", values="variation_per_second")
    best = errors.idxmin(axis=1)
    wins = [f"{controller} on {listed(list(best.index[best == controller]))}" for controller in best.unique()]
    sentences = [f"Lowest T_rmse: {'; '.join(wins)}."]
    for controller in [name for name in _names(scores) if name != FEED_FORWARD]:
        ratio = errors[controller] / errors[FEED_FORWARD]
        busier = (variation[controller] / variation[FEED_FORWARD]).median()
        if (ratio < 1.0).all():
            gain = f"is below the feed-forward's on every reference, by a factor of {number(1.0 / ratio.max(), 2)} to "
            gain += number(1.0 / ratio.min(), 2)
        else:
            gain = f"is not below the feed-forward's on {listed(list(ratio.index[ratio >= 1.0]))}"
        sentences.append(f"The T_rmse of {controller} {gain}; its voltage moves {number(busier, 2)} times as much.")
    return sentences


def _facts(comparison: Comparison) -> list[tuple[str, str]]:
    """What it was run with, in words."""
    found, units = comparison.conditions, comparison.units
    return [
        ("Rig", str(found["rig"])),
        ("Rate", f"{number(found['rate'])} samples a second"),
        (named("Amplitude of the references", units, "output"), number(found["amplitude"])),
        (named("Limit of the input, either way", units, "input"), number(found["voltage_limit"])),
        ("Seed", str(found["seed"])),
    ]


def _names(scores: pd.DataFrame) -> list[str]:
    return list(dict.fromkeys(scores["controller"]))


def _table(comparison: Comparison, score: str) -> Table:
    scores = comparison.scores
    names = _names(scores)
    rows: list[list[str | Cell]] = []
    for reference, mine in scores.groupby("reference", sort=False):
        best = mine[score].min()
        cells = [Cell(number(value, 3), strong=value == best) for value in mine[score]]
        floors = [Cell(number(mine[floor].iloc[0], 3), "quiet") for floor in ("noise_floor", "delay_floor")]
        rows.append([str(reference), *cells, *floors])
    what = {"t_rmse": "T_rmse, the RMS tracking error", "t_error": "T_error, the largest tracking error"}[score]
    header = ["Reference", *names, "Sensor noise, RMS", "One sample late, RMS"]
    return Table(
        named(what, comparison.units, "output"),
        header,
        rows,
        note="Of the true displacement. The best of a row is in bold.",
    )


def _effort(comparison: Comparison) -> Table:
    rows: list[list[str | Cell]] = [
        [
            row.reference,
            Cell(row.controller, "line"),
            number(row.total_variation, 3),
            number(row.variation_per_second, 3),
            number(row.measured_rmse, 3),
            Cell(percent(row.saturated_share, 2), "bad" if row.saturated_share > 0 else ""),
        ]
        for row in comparison.scores.itertuples()
    ]
    units = comparison.units
    header = ["Reference", "Controller", named("Total variation", units, "input"), f"A second ({units['input']}/s)",
              named("RMSE the sensor sees", units, "output"), "At the limit"]  # fmt: skip
    return Table("What it costs", header, rows, note="A chattering law moves the input far more than it needs to.")


def _settings(comparison: Comparison) -> Table:
    rows: list[Sequence[str | Cell]] = [
        [controller, setting.replace("_", " "), number(value, 6)]
        for controller, settings in comparison.tuning.items()
        for setting, value in settings.items()
    ]
    note = "In seconds, and in the units of input and output. The variants of a controller share its settings."
    if SLIDING in comparison.tuning:
        note += " convergence is C, layer the half width of the boundary layer."
    return Table("Settings, tuned on the model", ["Controller", "Setting", "Value"], rows, note=note)


def _pictures(folder: Path, comparison: Comparison) -> list[Picture]:
    names, found = _names(comparison.scores), []
    for reference, rows in comparison.responses.groupby("reference", sort=False):
        parts = {str(name): part for name, part in rows.groupby("controller", sort=False)}
        found.append(_followed(folder, str(reference), parts, names, comparison.units))
        found.append(_erred(folder, str(reference), parts, names, comparison))
    return found


def _followed(folder: Path, reference: str, parts: Parts, names: list[str], units: Units) -> Picture:
    caption = f"{reference}: reference and true displacement."

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        shown = [name for name in names if name in (FEED_FORWARD, PI, SLIDING)]
        for name in shown:
            part = _start(parts[name])
            axes.plot(part["time"], part["displacement"], color=COLOURS[names.index(name)], linewidth=1.1, label=name)
        part = _start(parts[shown[0]])
        axes.plot(part["time"], part["wanted"], color=INK, linewidth=0.9, linestyle=(0, (4, 3)), label="reference")
        axes.set(xlabel=named("Time", units, "time"), ylabel=named("Displacement", units, "output"))
        legend(axes, 4)

    return picture(
        folder, f"tracking-{reference}", (4.6, 2.7), alt=f"Tracking over time. {caption}", caption=caption, draw=draw
    )


def _erred(folder: Path, reference: str, parts: Parts, names: list[str], comparison: Comparison) -> Picture:
    units, largest = comparison.units, max(float(part["error"].abs().max()) for part in parts.values())
    heard = max(float(comparison.scores["noise_floor"].iloc[0]), 1e-6 * largest, 1e-12)
    linear = 10.0 ** math.ceil(math.log10(heard))
    caption = (
        f"{reference}: reference minus true displacement, on a scale that is linear within {number(linear)}, the power "
        "of ten above the sensor's noise, and logarithmic beyond."
    )

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.axhline(0, color=MUTED, linewidth=0.8)
        for name in names:
            part = _start(parts[name])
            axes.plot(part["time"], part["error"], color=COLOURS[names.index(name)], linewidth=0.9, label=name)
        axes.set_yscale("symlog", linthresh=linear)
        axes.set(xlabel=named("Time", units, "time"), ylabel=named("Error", units, "output"))
        legend(axes, 2)

    return picture(
        folder, f"error-{reference}", (4.6, 3.1), alt=f"Tracking error over time. {caption}", caption=caption, draw=draw
    )


def _start(part: pd.DataFrame) -> pd.DataFrame:
    """Fast references: the first tenth of a second or so is enough to see, all of it is scored."""
    duration = float(part["time"].iloc[-1] - part["time"].iloc[0])
    return part if duration > 1.0 else part[part["time"] <= part["time"].iloc[0] + 0.2]

"""The page of a control comparison: who follows best, at what chatter, beside the floor."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from hysteresis_bench.csv_files import write_table
from hysteresis_bench.report.shared.page import Cell, Table, listed, number, percent, render
from hysteresis_bench.report.shared.signal_figures import named
from hysteresis_bench.report.shared.theme import INK, MUTED, SERIES, Picture, picture

if TYPE_CHECKING:
    from rich.console import Console

    from hysteresis_bench.control.comparison import Comparison

PAGE, SCORES, RESPONSES = "control.html", "control.csv", "responses.csv"


def write_control(folder: Path, comparison: Comparison, model: str) -> Path:
    """Write control.csv, responses.csv, figures and control.html into the folder; returns the page.

    model : what the model is called, for the title
    """
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / SCORES, comparison.scores, digits=6)
    write_table(folder / RESPONSES, comparison.responses, digits=6)
    page = folder / PAGE
    told = comparison.conditions
    text = render(
        "control.html.j2",
        title=f"{model} in control of the rig {told['rig']}",
        kicker=f"{told['rate']:g} samples a second, voltage within ±{told['voltage_limit']:g}",
        answer=answer(comparison.scores),
        warnings=list(comparison.warnings),
        errors=[_table(comparison, score) for score in ("t_rmse", "t_error")],
        effort=_effort(comparison),
        pictures=_pictures(folder, comparison),
        settings=_settings(comparison),
        controllers=list(_meanings(comparison).items()),
        notes=list(comparison.notes),
        facts=[(key.replace("_", " ").capitalize(), f"{value}") for key, value in told.items()],
    )
    page.write_text(text, encoding="utf-8")
    return page


def print_control(comparison: Comparison, console: Console) -> None:
    """T_rmse of every controller on every reference, the answer, the warnings."""
    from rich.markup import escape
    from rich.table import Table as Terminal

    scores = comparison.scores
    errors = scores.pivot(index="controller", columns="reference", values="t_rmse")
    references = list(dict.fromkeys(scores["reference"]))
    unit = scores["unit"].iloc[0]
    table = Terminal(title=f"T_rmse [{unit}]", title_justify="left", box=None, title_style="bold", pad_edge=False)
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
    for warning in comparison.warnings:
        console.print(f"[yellow]note:[/] {escape(warning)}", highlight=False)


def answer(scores: pd.DataFrame) -> list[str]:
    """Who follows best, whether the compound controllers beat the feed-forward everywhere, and at what chatter."""
    errors = scores.pivot(index="reference", columns="controller", values="t_rmse")
    variation = scores.pivot(index="reference", columns="controller", values="variation_per_second")
    best = errors.idxmin(axis=1)
    wins = [f"{controller} on {listed(list(best.index[best == controller]))}" for controller in best.unique()]
    told = [f"Lowest T_rmse: {'; '.join(wins)}."]
    for controller in [name for name in _names(scores) if name != "feed-forward"]:
        ratio = errors[controller] / errors["feed-forward"]
        busier = (variation[controller] / variation["feed-forward"]).median()
        if (ratio < 1.0).all():
            gain = f"is below the feed-forward's on every reference, by a factor of {number(1.0 / ratio.max(), 2)} to "
            gain += number(1.0 / ratio.min(), 2)
        else:
            gain = f"is not below the feed-forward's on {listed(list(ratio.index[ratio >= 1.0]))}"
        told.append(f"The T_rmse of {controller} {gain}; its voltage moves {number(busier, 2)} times as much.")
    return told


def _names(scores: pd.DataFrame) -> list[str]:
    return list(dict.fromkeys(scores["controller"]))


def _meanings(comparison: Comparison) -> dict[str, str]:
    from hysteresis_bench.control.comparison import MEANINGS

    return {name: MEANINGS[name] for name in _names(comparison.scores)}


def _table(comparison: Comparison, score: str) -> Table:
    scores, unit = comparison.scores, comparison.scores["unit"].iloc[0]
    names = _names(scores)
    rows: list[list[str | Cell]] = []
    for reference, mine in scores.groupby("reference", sort=False):
        best = mine[score].min()
        cells = [Cell(number(value, 3), strong=value == best) for value in mine[score]]
        floors = [Cell(number(mine[floor].iloc[0], 3), "quiet") for floor in ("noise_floor", "delay_floor")]
        rows.append([str(reference), *cells, *floors])
    what = {"t_rmse": "T_rmse, the RMS tracking error", "t_error": "T_error, the largest tracking error"}[score]
    header = ["Reference", *names, "Sensor noise", "One sample late"]
    return Table(f"{what} ({unit})", header, rows, note="Of the true displacement. The best of a row is in bold.")


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
    unit, volts = comparison.scores["unit"].iloc[0], comparison.units["input"]
    header = ["Reference", "Controller", f"Total variation ({volts})", f"A second ({volts}/s)",
              f"RMSE the sensor sees ({unit})", "At the voltage limit"]  # fmt: skip
    return Table("What it costs", header, rows, note="A chattering law moves the voltage far more than it needs to.")


def _settings(comparison: Comparison) -> Table:
    rows: list[Sequence[str | Cell]] = [
        [controller, setting.replace("_", " "), number(value, 6)]
        for controller, settings in comparison.tuning.items()
        for setting, value in settings.items()
    ]
    note = (
        "convergence is C, layer the half width of the boundary layer; seconds and the output's unit. "
        "The variants of a controller share its settings."
    )
    return Table("Settings, tuned on the model", ["Controller", "Setting", "Value"], rows, note=note)


def _pictures(folder: Path, comparison: Comparison) -> list[Picture]:
    names, found = _names(comparison.scores), []
    for reference, rows in comparison.responses.groupby("reference", sort=False):
        parts = {name: part for name, part in rows.groupby("controller", sort=False)}
        found.append(_followed(folder, str(reference), parts, names, comparison.units))
        found.append(_erred(folder, str(reference), parts, names, comparison.units))
    return found


def _followed(folder: Path, reference: str, parts: dict, names: list[str], units: Any) -> Picture:
    caption = f"{reference}: reference and true displacement."

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        shown = [name for name in names if name in ("feed-forward", "pi", "sliding-mode")]
        for name in shown:
            part = _start(parts[name])
            axes.plot(part["time"], part["displacement"], color=SERIES[names.index(name)], linewidth=1.1, label=name)
        part = _start(parts[shown[0]])
        axes.plot(part["time"], part["wanted"], color=INK, linewidth=0.9, linestyle=(0, (4, 3)), label="reference")
        axes.set(xlabel=named("Time", units, "time"), ylabel=named("Displacement", units, "output"))
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=4, borderaxespad=0, handlelength=1.4)

    return picture(folder, f"tracking-{reference}", (4.6, 2.7), f"Tracking over time. {caption}", caption, draw)


def _erred(folder: Path, reference: str, parts: dict, names: list[str], units: Any) -> Picture:
    caption = f"{reference}: reference minus true displacement, on a scale that is linear within 0.01 and logarithmic "
    caption += "beyond."

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.axhline(0, color=MUTED, linewidth=0.8)
        for name in names:
            part = _start(parts[name])
            axes.plot(part["time"], part["error"], color=SERIES[names.index(name)], linewidth=0.9, label=name)
        axes.set_yscale("symlog", linthresh=0.01)
        axes.set(xlabel=named("Time", units, "time"), ylabel=named("Error", units, "output"))
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=3, borderaxespad=0, handlelength=1.4)

    return picture(folder, f"error-{reference}", (4.6, 2.9), f"Tracking error over time. {caption}", caption, draw)


def _start(part: pd.DataFrame) -> pd.DataFrame:
    """Fast references: the first tenth of a second or so is enough to see, all of it is scored."""
    duration = float(part["time"].iloc[-1] - part["time"].iloc[0])
    return part if duration > 1.0 else part[part["time"] <= part["time"].iloc[0] + 0.2]

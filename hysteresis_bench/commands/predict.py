"""The command `predict`: the output of data with a fitted model, and how far it is from what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.data.options import data_options, say_understood
from hysteresis_bench.commands.outputs import check_plot, check_table, force_option, plot_option
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import plain_console, say_notes, say_path

if TYPE_CHECKING:
    from hysteresis_bench.data.layout import Layout
    from hysteresis_bench.fit.model_file import FittedModel
    from hysteresis_bench.signals import Dataset


@click.command()
@click.argument("model", type=click.Path(path_type=Path))
@click.argument("data", type=click.Path(path_type=Path), nargs=-1, required=True)
@data_options
@click.option(
    "--interval", "level", type=click.Choice(("50", "68", "90", "95", "99")), default="90", help="Percent; default: 90."
)
@plot_option
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
@json_option
@force_option
def predict(
    model: Path,
    data: Sequence[Path],
    layout: Layout,
    level: str,
    plot: Path | None,
    out: Path,
    as_json: bool,
    force: bool,
) -> None:
    """Predict the output of DATA ... with a fitted MODEL.json, prepared as for its fit, with an interval beside it."""
    check_table(out, (model, *data), force)
    from hysteresis_bench.data.data_files import read_data, write_csv
    from hysteresis_bench.fit.checks.faulty_records import counted
    from hysteresis_bench.fit.model_file import read_model
    from hysteresis_bench.report.shared.papers import draw_prediction

    check_plot(plot, (model, *data), force)
    fitted, console = read_model(model), plain_console()
    measured = read_data(data, output_needed=False, units=fitted.units, layout=layout)
    predicted, known = fitted.predict(measured, int(level)), fitted.in_own_units(measured)
    write_csv(out, predicted)
    errors, within = fitted.errors(measured), _within(known, predicted)
    promised = _promised(fitted, known, int(level))
    notes = (*predicted.notes, *counted(known.records))
    if plot is not None:
        draw_prediction(plot, known, predicted)
    if as_json:
        found = {name: {**error.as_dict(), "within": within.get(name)} for name, error in errors.items()}
        say_json({"records": found, "interval": promised, "notes": notes, "prediction": out, "figure": plot})
        return
    say_understood(console, measured)
    say_notes(console, notes)
    unit = "" if fitted.units["output"] == "1" else f" {fitted.units['output']}"
    for record, error in errors.items():
        told = f"relative RMS {error.relative_rms:.2%}, largest error {error.max_error:.2%}"
        told += f", {within[record]:.0%} of its samples within the interval" if record in within else ""
        console.print(f"{record}: RMSE {error.rmse:.4g}{unit}, {told}", highlight=False, markup=False)
    for sentence in promised:
        console.print(sentence, highlight=False, markup=False)
    say_path(console, "prediction", out)
    if plot is not None:
        say_path(console, "figure", plot)


def _promised(fitted: FittedModel, known: Dataset, level: int) -> list[str]:
    """What the interval promises, and for which records it need not hold."""
    if fitted.interval is None:
        return ["The model file keeps no interval; fit again for one."]
    ranges = fitted.data.get("ranges", {}).get("input", ())
    beyond = (sentence for record in known.records for sentence in fitted.interval.beyond(record, ranges))
    asked = dict.fromkeys(record.output is not None for record in known.records)
    said = dict.fromkeys(fitted.interval.words(level, fitted.units["output"], measured) for measured in asked)
    return [*said, *beyond]


def _within(known: Dataset, predicted: Dataset) -> dict[str, float]:
    """The share of each measured record's scored samples that lies in the interval, where there is one."""
    from hysteresis_bench.fit.unseen.interval import HIGH, LOW

    found = {}
    for record, made in zip(known.records, predicted.records, strict=True):
        if record.output is not None and LOW in made.columns and made.history < made.time.size:
            inside = (made.columns[LOW] <= record.output) & (record.output <= made.columns[HIGH])
            found[record.name] = float(inside[made.scored].mean())
    return found

"""The command `fit`: parameters with standard errors, model.json, a figure, a page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hysteresis_bench.commands.data.loading import loaded, model_faults
from hysteresis_bench.commands.data.options import data_options, preparation_options, say_understood
from hysteresis_bench.commands.data.parameters import model_options
from hysteresis_bench.commands.outputs import check_folder, check_plot, force_option, plot_option
from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import open_option, plain_console, say_notes, say_page, say_path

if TYPE_CHECKING:
    from hysteresis_bench.data.layout import Layout


@click.command()
@click.argument("data", type=click.Path(path_type=Path), nargs=-1, required=True)
@data_options
@click.option("--model", default="", help="A registered model; see `list models`.")
@click.option("--effect", "effects", multiple=True, help="An effect around the model; may be repeated.")
@model_options
@click.option("--held-out", multiple=True, metavar="RECORD", help="A record that is not fitted.")
@preparation_options
@click.option("--seed", type=int, default=0, show_default=True, help="Of all random numbers.")
@click.option("--optimizer", help="A registered optimizer; see `list optimizers`.")
@click.option("--budget", type=click.IntRange(min=1), help="Evaluations of each of the two searches.")
@plot_option
@json_option
@open_option
@force_option
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="Where model.json, the figure and the page go; default: NAME-fit.",
)
def fit(
    data: Sequence[Path],
    layout: Layout,
    model: str,
    effects: Sequence[str],
    asked: dict[str, Any],
    held_out: Sequence[str],
    prepared: dict[str, Any],
    seed: int,
    optimizer: str | None,
    budget: int | None,
    plot: Path | None,
    as_json: bool,
    open_page: bool,
    force: bool,
    out: Path | None,
) -> None:
    """Fit a model to DATA ...: parameters with standard errors, model.json, a figure, a page.

    A run that was stopped goes on after its last finished search when it is called again.
    """
    from hysteresis_bench.errors import UserError

    if not model:
        raise UserError(
            "fit",
            "name a law with --model; `list models` shows them, `compare` ranks them on your data, and `diagnose` "
            "finds one without --model.",
        )
    from hysteresis_bench import FitOptions
    from hysteresis_bench import fit as fit_model
    from hysteresis_bench.commands.data.journal import journal
    from hysteresis_bench.commands.terminal.steps import steps_told
    from hysteresis_bench.report.fit.folder import FILES, print_fit, write_fit
    from hysteresis_bench.report.fit.page import FILE
    from hysteresis_bench.report.shared.papers import draw_fit

    folder = out or Path(f"{data[0].stem}-fit")
    check_folder(folder, FILES, FILE, data, force)
    check_plot(plot, data, force)
    others = partial(model_faults, model, effects, asked, optimizer)
    dataset, console = loaded("fit", data, held_out, layout, others=others), plain_console()
    if not as_json:
        say_understood(console, dataset)
        say_notes(console, dataset.notes)
    default = FitOptions()
    options = FitOptions(
        optimizer=optimizer or default.optimizer,
        budget=budget or default.budget,
        seed=seed,
        **prepared,
    )
    with journal(folder, (dataset.records, held_out, model, effects, asked, options)) as kept:
        say_notes(plain_console(aside=True), kept.notes)
        with told_when_stopped("fit", kept.words), steps_told("fit") as on_step:
            options = replace(options, on_step=on_step, kept=kept)
            fitted = fit_model(dataset, model, effects, **asked, options=options)
        page = write_fit(folder, fitted, data)
    if plot is not None:
        draw_fit(plot, fitted.responses, fitted.model.units)
    if as_json:
        tables = {"parameters": fitted.parameters.to_dict("records"), "records": fitted.records.to_dict("records")}
        said = {"agreement": fitted.agreement, "warnings": fitted.warnings, "notes": fitted.notes}
        say_json({"model": fitted.model.model, **tables, **said, "page": page, "figure": plot})
        return
    print_fit(fitted, console)
    if plot is not None:
        say_path(console, "figure", plot)
    say_page(console, page, open_page)

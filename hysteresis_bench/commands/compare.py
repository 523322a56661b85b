"""The command `compare`: which law predicts best what it did not see."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hysteresis_bench.commands.data.loading import loaded
from hysteresis_bench.commands.data.options import data_options, models_option, preparation_options, say_understood
from hysteresis_bench.commands.outputs import check_folder, check_plot, force_option, plot_option
from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import open_option, plain_console, say_notes, say_page, say_path

if TYPE_CHECKING:
    from hysteresis_bench.data.layout import Layout

OUT_HELP = "Folder, where earlier results of this command are replaced; default: NAME-laws."


@click.command()
@click.argument("data", type=click.Path(path_type=Path), nargs=-1, required=True)
@data_options
@models_option("Registered models.")
@click.option("--effect", "effects", multiple=True, help="An effect known to act around every law; may be repeated.")
@click.option("--held-out", multiple=True, metavar="RECORD", help="A record that is only predicted.")
@preparation_options
@click.option("--jobs", type=click.IntRange(min=1), help="Processes; default: all cores, at most 4.")
@click.option("--seed", type=int, default=0, show_default=True, help="Of all random numbers.")
@plot_option
@json_option
@open_option
@force_option
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help=OUT_HELP)
def compare(
    data: Sequence[Path],
    layout: Layout,
    models: Sequence[str],
    effects: Sequence[str],
    held_out: Sequence[str],
    prepared: dict[str, Any],
    jobs: int | None,
    seed: int,
    plot: Path | None,
    as_json: bool,
    open_page: bool,
    force: bool,
    out: Path | None,
) -> None:
    """Fit every law to DATA ... and rank them by what they did not see, beside a polynomial without memory.

    A run that was stopped goes on where it was when it is called again.
    """
    from dataclasses import replace
    from functools import partial

    from hysteresis_bench import compare as compare_laws
    from hysteresis_bench.commands.data.journal import journal
    from hysteresis_bench.commands.terminal.steps import steps_told
    from hysteresis_bench.diagnosis.laws.comparison import law_faults
    from hysteresis_bench.diagnosis.question import DiagnosisOptions
    from hysteresis_bench.report.laws.page import FILE, FILES, draw_comparison, print_comparison, write_comparison

    folder = out or Path(f"{data[0].stem}-laws")
    check_folder(folder, FILES, FILE, data, force)
    check_plot(plot, data, force)
    others = partial(law_faults, models, effects)
    dataset, console = loaded("compare", data, held_out, layout, others=others), plain_console(aside=as_json)
    if not as_json:
        say_understood(console, dataset)
    say_notes(console, dataset.notes)
    options = DiagnosisOptions(seed, None, **prepared)
    with journal(folder, (dataset.records, held_out, models, effects, options)) as kept:
        say_notes(plain_console(aside=True), kept.notes)
        with told_when_stopped("compare", kept.words), steps_told("compare") as on_step:
            options = replace(options, jobs=jobs, on_step=on_step, kept=kept)
            found = compare_laws(dataset, models, effects, options=options)
        page = write_comparison(folder, found, data)
    if plot is not None:
        draw_comparison(plot, found)
    if as_json:
        say_json({**found.as_dict(), "notes": found.notes, "page": page, "figure": plot})
    else:
        print_comparison(found, console)
        if plot is not None:
            say_path(console, "figure", plot)
    say_page(console, page, open_page)

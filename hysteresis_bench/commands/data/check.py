"""The command `check`: what was understood of data files, and what is odd about them."""

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
    from hysteresis_bench.signals import Record


@click.command()
@click.argument("data", type=click.Path(path_type=Path), nargs=-1, required=True)
@data_options
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), help="Write the records as a plain CSV.")
@plot_option
@json_option
@force_option
def check(
    data: Sequence[Path], layout: Layout, out: Path | None, plot: Path | None, as_json: bool, force: bool
) -> None:
    """Tell how DATA ... are read, draw them, and warn of what a model would take for the actuator."""
    from hysteresis_bench.data.data_files import read_data, write_csv
    from hysteresis_bench.inspection.oddities import oddities
    from hysteresis_bench.report.shared.papers import draw_records

    if out is not None:
        check_table(out, data, force)
    check_plot(plot, data, force)
    dataset = read_data(data, output_needed=False, layout=layout)
    warnings = oddities(dataset.records)
    if lacking := [record.name for record in dataset.records if record.output is None]:
        warnings = (f"{lacking[0]}: no column of the output was found; --output NAME says which it is.", *warnings)
    if as_json:
        content = {"records": [dict(row) for row in dataset.understood], "notes": dataset.notes, "warnings": warnings}
        say_json(content)
    else:
        console = plain_console()
        say_understood(console, dataset)
        say_notes(console, dataset.notes)
        _draw(dataset.records[0])
        for warning in warnings:
            console.print(warning, style="yellow", highlight=False, markup=False)
        if not warnings:
            console.print("Nothing is odd about these records.", highlight=False)
    if out is not None:
        write_csv(out, dataset)
    if plot is not None:
        draw_records(plot, dataset)
    if not as_json:
        for what, path in (("records", out), ("figure", plot)):
            if path is not None:
                say_path(console, what, path)


def _draw(record: Record) -> None:
    """The first record's loop, or its input where there is no output."""
    from hysteresis_bench.commands.terminal.loop import drawn

    x, y = (record.time, record.input) if record.output is None else (record.input, record.output)
    click.echo(
        f"\n{record.name}: {'input over time' if record.output is None else 'output over input'}\n{drawn([(x, y)])}\n"
    )

"""The command `measure`: data from a virtual rig."""

from __future__ import annotations

from pathlib import Path

import click

from hysteresis_bench.commands.outputs import check_plot, check_table, force_option, plot_option
from hysteresis_bench.commands.terminal.console import plain_console, say_path


@click.command()
@click.argument("rig")
@click.argument("experiment")
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
@click.option("--seed", type=int, default=0, show_default=True, help="Of all random numbers.")
@plot_option
@force_option
def measure(rig: str, experiment: str, out: Path, seed: int, plot: Path | None, force: bool) -> None:
    """Take data from a virtual RIG (see `list rigs`)."""
    from hysteresis_bench import measure as measure_on_rig

    check_table(out, force=force)
    check_plot(plot, (out,), force)
    from hysteresis_bench.data.data_files import write_csv

    taken = measure_on_rig(rig, experiment, seed=seed)
    write_csv(out, taken)
    say_path(plain_console(), "data", out)
    if plot is not None:
        from hysteresis_bench.report.shared.papers import draw_records

        draw_records(plot, taken)
        say_path(plain_console(), "figure", plot)

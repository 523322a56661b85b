"""The command `measure`: data from a virtual rig."""

from __future__ import annotations

from pathlib import Path

import click

from hysteresis_bench.commands.outputs import check_file, force_option
from hysteresis_bench.commands.terminal.console import plain_console, say_path


@click.command()
@click.argument("rig")
@click.argument("experiment")
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
@click.option("--seed", type=int, default=0, show_default=True, help="Of all random numbers.")
@force_option
def measure(rig: str, experiment: str, out: Path, seed: int, force: bool) -> None:
    """Take data from a virtual RIG (see `list rigs`)."""
    from hysteresis_bench import measure as measure_on_rig

    check_file(out, force=force)
    from hysteresis_bench.data.data_files import write_csv

    write_csv(out, measure_on_rig(rig, experiment, seed=seed))
    say_path(plain_console(), "data", out)

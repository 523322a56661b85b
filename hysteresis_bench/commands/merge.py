"""The command `merge`: the parts of a study, run elsewhere, put together."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from hysteresis_bench.commands.terminal.console import plain_console


@click.command()
@click.argument("results", type=click.Path(path_type=Path, file_okay=False), nargs=-1, required=True)
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), required=True, help="The folder to make.")
def merge(results: tuple[Path, ...], out: Path) -> None:
    """Put the trials of several RESULTS folders of one study into a new one, such as those of `run --shard`.

    Then `run STUDY.toml --out` that folder runs what is missing and writes the tables and the report.
    """
    from hysteresis_bench.study.execution.shards import merge as merge_folders

    console = plain_console()
    trials = merge_folders(results, out)
    console.print(f"{trials} trials of {len(results)} folders are together. For tables and report:", highlight=False)
    follows = f"hysteresis-bench run STUDY.toml --out {shlex.quote(str(out))}"
    console.print(follows, highlight=False, soft_wrap=True, markup=False)

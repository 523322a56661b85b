"""The command `export`: a fitted model as one file that needs nothing of this package."""

from __future__ import annotations

from pathlib import Path

import click

from hysteresis_bench.commands.outputs import check_file, force_option
from hysteresis_bench.commands.terminal.console import plain_console, say_path


@click.command()
@click.argument("model", type=click.Path(path_type=Path))
@click.option("--to", "target", required=True, metavar="TARGET", help="python or c, in letters of either case.")
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), help="The file; default: MODEL.py or MODEL.c.")
@force_option
def export(model: Path, target: str, out: Path | None, force: bool) -> None:
    """Write a fitted MODEL.json as one file of Python or C99: one sample in, one out, with its inverse."""
    from hysteresis_bench.export.write import SUFFIXES, exported, write_export
    from hysteresis_bench.fit.model_file import read_model

    target = target.lower()  # the language is called C
    fitted = read_model(model)
    exported(fitted, target)
    path = out or model.with_suffix(SUFFIXES[target])
    check_file(path, (model,), force)
    console = plain_console()
    for sentence in write_export(path, fitted, target):
        console.print(sentence, highlight=False, markup=False)
    say_path(console, "exported", path)

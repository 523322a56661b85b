"""The command line: arguments in, one call, tables and paths out."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
from rich.console import Console
from rich.markup import escape

from hysteresis_bench.commands.check_plugin import check_plugin
from hysteresis_bench.commands.console import plain_console, say_path
from hysteresis_bench.commands.control import control
from hysteresis_bench.commands.diagnose import diagnose
from hysteresis_bench.commands.fit import fit
from hysteresis_bench.commands.list import list_plugins
from hysteresis_bench.commands.new_plugin import new_plugin
from hysteresis_bench.commands.report import report
from hysteresis_bench.commands.run import run
from hysteresis_bench.errors import UserError, nearest

USER_AT_FAULT = 2

existing_file = click.Path(path_type=Path)


class Group(click.Group):
    """Tells a user's mistake in one message, without a traceback, and exits with 2."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        try:
            return super().main(*args, **kwargs)
        except UserError as error:
            Console(stderr=True, soft_wrap=True).print(f"[bold red]error:[/] {escape(str(error))}", highlight=False)
            sys.exit(USER_AT_FAULT)

    def resolve_command(self, context: click.Context, args: list[str]) -> Any:
        if args and self.get_command(context, args[0]) is None:
            raise UserError("hysteresis-bench", f'no command "{args[0]}". {nearest(args[0], self.commands)}')
        return super().resolve_command(context, args)


@click.group(cls=Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="hysteresis-bench")
def main() -> None:
    """Identify hysteresis models of actuators from measured data, settle which optimizer is worth using,
    and find what the model lacks."""


@main.command()
@click.argument("model", type=existing_file)
@click.argument("data", type=existing_file, nargs=-1, required=True)
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
def predict(model: Path, data: Sequence[Path], out: Path) -> None:
    """Predict the output of DATA.csv ... with a fitted MODEL.json."""
    from hysteresis_bench import predict as predict_output
    from hysteresis_bench.data_files import write_csv

    write_csv(out, predict_output(model, *data))
    say_path(plain_console(), "prediction", out)


@main.command()
@click.argument("rig")
@click.argument("experiment")
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
@click.option("--seed", type=int, default=0, show_default=True)
def measure(rig: str, experiment: str, out: Path, seed: int) -> None:
    """Take data from a virtual RIG (see `list rigs`)."""
    from hysteresis_bench import measure as measure_on_rig
    from hysteresis_bench.data_files import write_csv

    write_csv(out, measure_on_rig(rig, experiment, seed=seed))
    say_path(plain_console(), "data", out)


for command in (check_plugin, control, diagnose, fit, list_plugins, new_plugin, report, run):
    main.add_command(command)

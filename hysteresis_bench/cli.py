"""The command line: arguments in, one call, tables and paths out."""

from __future__ import annotations

import sys
from typing import Any

import click

from hysteresis_bench.commands.compare import compare
from hysteresis_bench.commands.control.control import control
from hysteresis_bench.commands.data.check import check
from hysteresis_bench.commands.data.export import export
from hysteresis_bench.commands.data.new_study import new_study
from hysteresis_bench.commands.data.schema import schema
from hysteresis_bench.commands.diagnose import diagnose
from hysteresis_bench.commands.fit import fit
from hysteresis_bench.commands.measure import measure
from hysteresis_bench.commands.merge import merge
from hysteresis_bench.commands.plugins.check_plugin import check_plugin
from hysteresis_bench.commands.plugins.list import list_plugins
from hysteresis_bench.commands.plugins.new_plugin import new_plugin
from hysteresis_bench.commands.predict import predict
from hysteresis_bench.commands.report import report
from hysteresis_bench.commands.run import run
from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.errors import UserError, nearest

USER_AT_FAULT = 2


class Group(click.Group):
    """Tells a user's mistake in one message, without a traceback, and exits with 2."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        try:
            return super().main(*args, **kwargs)
        except UserError as error:
            told = str(error)
        except OSError as error:  # a folder that cannot be written, a full disk
            told = f"{error.filename or self.name}: {error.strerror or error}."
        from rich.markup import escape

        from hysteresis_bench.commands.terminal.console import terminal

        terminal(aside=True, soft_wrap=True).print(f"[bold red]error:[/] {escape(told)}", highlight=False)
        sys.exit(USER_AT_FAULT)

    def invoke(self, context: click.Context) -> Any:
        with told_when_stopped(context.info_name or "", lambda: "what it has told of is kept"):
            return super().invoke(context)

    def resolve_command(self, context: click.Context, args: list[str]) -> Any:
        if args and self.get_command(context, args[0]) is None:
            raise UserError("hysteresis-bench", f'no command "{args[0]}". {nearest(args[0], self.commands)}')
        return super().resolve_command(context, args)


@click.group(cls=Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="hysteresis-bench")
def main() -> None:
    """Identify hysteresis models of actuators from measured data, settle which optimizer is worth using,
    and find what the model lacks."""


COMMANDS = (
    check,
    check_plugin,
    compare,
    control,
    diagnose,
    export,
    fit,
    list_plugins,
    measure,
    merge,
    new_plugin,
    new_study,
    predict,
    report,
    run,
    schema,
)
for command in COMMANDS:
    main.add_command(command)

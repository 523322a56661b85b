"""The options of every command that reads data files, handed on as one layout."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from hysteresis_bench.commands.data.finite import finite

if TYPE_CHECKING:
    from rich.console import Console

    from hysteresis_bench.signals import Dataset

OPTIONS = (
    click.option("--time", metavar="COLUMN", help="The column of the time: its name, or its position from 1."),
    click.option("--input", metavar="COLUMN", help="The column of the input."),
    click.option("--output", metavar="COLUMN", help="The column of the output."),
    click.option(
        "--rate", type=float, metavar="HZ", help="Samples a second, where there is no column of time, or in its place."
    ),
    click.option("--delimiter", metavar="MARK", help="Between cells: comma, semicolon, tab, bar or space."),
    click.option("--decimal", metavar="MARK", help="Decimal mark, . or , where the file leaves it open."),
    click.option("--sheet", metavar="NAME", help="The only sheet or variable to read."),
)
NAMES = ("time", "input", "output", "rate", "delimiter", "decimal", "sheet")

PREPARATION = (
    click.option("--input-offset", type=float, callback=finite, default=0.0, help="Subtracted from the input."),
    click.option("--flip", is_flag=True, help="Change the sign of the input."),
    click.option(
        "--skip",
        type=click.FloatRange(min=0),
        callback=finite,
        default=0.0,
        help="Seconds at the start that are not scored.",
    ),
    click.option(
        "--settle/--no-settle",
        default=None,
        help="Repeat closed loops until they close, before scoring; default: where the records are settled periods.",
    ),
)
PREPARED = ("input_offset", "flip", "skip", "settle")

Command = Callable[..., Any]


def packing(
    options: Sequence[Callable[[Command], Command]], names: Sequence[str], into: str, pack: Callable[..., Any]
) -> Callable[[Command], Command]:
    """A decorator that gives a command these options, and hands it what `pack` makes of them as one argument.

    names : of the options' values, as `pack` takes them;  into : the command's argument
    """

    def decorated(command: Command) -> Command:
        @wraps(command)
        def packed(**given: Any) -> Any:
            own = {name: given.pop(name) for name in names}
            return command(**{into: pack(**own)}, **given)

        offered: Command = packed
        for option in reversed(options):
            offered = option(offered)
        return offered

    return decorated


def _layout(**given: Any) -> Any:
    from hysteresis_bench.data.layout import Layout

    return Layout(**given)


data_options = packing(OPTIONS, NAMES, "layout", _layout)
"""How files are read, as `layout`."""

OF_A_REFERENCE = tuple(name for name in NAMES if name not in ("input", "rate"))
reference_options = packing([OPTIONS[NAMES.index(name)] for name in OF_A_REFERENCE], OF_A_REFERENCE, "layout", _layout)
"""How a file of a wanted output is read, as `layout`."""

preparation_options = packing(PREPARATION, PREPARED, "prepared", dict)
"""What is done to every record, as `prepared`: fields of FitOptions and of DiagnosisOptions."""


def models_option(told: str) -> Callable[[Command], Command]:
    """`--models A,B,...` as `models`: names, none of them for all.  told : its help"""

    def names(context: click.Context, option: click.Parameter, text: str) -> tuple[str, ...]:
        return () if text == "all" else tuple(name.strip() for name in text.split(","))

    return click.option("--models", default="all", show_default=True, metavar="A,B,...", help=told, callback=names)


def say_understood(console: Console, dataset: Dataset) -> None:
    """The table of what was read, a row a record; records beyond a screen are counted."""
    from rich.markup import escape
    from rich.table import Table

    rows = dataset.understood
    table = Table(title="read as", title_justify="left", box=None, title_style="bold", pad_edge=False)
    for heading in rows[0] if rows else ():
        table.add_column(heading, justify="right" if heading in ("samples", "gaps") else "left", overflow="fold")
    for row in rows[:RECORDS_SHOWN]:
        table.add_row(*(escape(text) for text in row.values()))
    console.print(table, highlight=False)
    if len(rows) > RECORDS_SHOWN:
        console.print(f"and {len(rows) - RECORDS_SHOWN} more records.", highlight=False)


RECORDS_SHOWN = 20
"""Records that a terminal shows."""

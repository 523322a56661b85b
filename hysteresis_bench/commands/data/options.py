"""The options of every command that reads data files, handed on as one layout."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console

    from hysteresis_bench.signals import Dataset

OPTIONS = (
    click.option("--time", metavar="COLUMN", help="The column of the time: its name, or its position from 1."),
    click.option("--input", metavar="COLUMN", help="The column of the input."),
    click.option("--output", metavar="COLUMN", help="The column of the output."),
    click.option("--rate", type=float, metavar="HZ", help="Samples a second, where there is no column of time."),
    click.option("--delimiter", metavar="MARK", help="Between cells: comma, semicolon, tab, bar or space."),
    click.option("--decimal", metavar="MARK", help="Decimal mark, . or , where the file leaves it open."),
    click.option("--sheet", metavar="NAME", help="The only sheet or variable to read."),
)
NAMES = ("time", "input", "output", "rate", "delimiter", "decimal", "sheet")


def data_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The command with these options; it gets them as `layout`."""

    @wraps(command)
    def packed(**given: Any) -> Any:
        from hysteresis_bench.data.layout import Layout

        layout = Layout(**{name: given.pop(name) for name in NAMES})
        return command(layout=layout, **given)

    for option in reversed(OPTIONS):
        packed = option(packed)
    return packed


def say_understood(console: Console, dataset: Dataset) -> None:
    """The table of what was read, a row a record; records beyond a screen are counted."""
    from rich.markup import escape
    from rich.table import Table

    rows = dataset.understood
    table = Table(title="read as", title_justify="left", box=None, title_style="bold", pad_edge=False)
    for heading in rows[0] if rows else ():
        table.add_column(heading, justify="right" if heading in ("samples", "gaps") else "left", overflow="fold")
    for row in rows[:MOST]:
        table.add_row(*(escape(text) for text in row.values()))
    console.print(table, highlight=False)
    if len(rows) > MOST:
        console.print(f"and {len(rows) - MOST} more records.", highlight=False)


MOST = 20
"""Records that a terminal shows."""

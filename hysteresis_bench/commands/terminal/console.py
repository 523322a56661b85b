"""The terminal that commands print to."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from rich.console import Console

open_option = click.option("--open", "open_page", is_flag=True, help="Open the page in a browser.")


def terminal(aside: bool = False, soft_wrap: bool = False) -> Console:
    """Where all of it is printed: names as they are, a record ":b:" is no picture.  aside : on standard error"""
    from rich.console import Console

    return Console(stderr=aside, soft_wrap=soft_wrap, emoji=False)


def plain_console(aside: bool = False) -> Console:
    """As wide as the terminal; 120 columns for a file or a pipe, which have no width of their own.

    aside : on standard error, where standard output is for a program
    """
    console = terminal(aside)
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = 120
    return console


def say_notes(console: Console, notes: Sequence[str]) -> None:
    """What was done to the data, a line each."""
    from rich.markup import escape

    for note in notes:
        console.print(f"[yellow]note:[/] {escape(note)}", highlight=False, soft_wrap=True)


def say_path(console: Console, what: str, path: Path) -> None:
    """Where something was written, on one line however long the path is."""
    console.print(f"{what}: {path}", highlight=False, soft_wrap=True, markup=False)


def say_page(console: Console, page: Path, wanted: bool, what: str = "page") -> None:
    """Where a page is; and opened, where that is wanted and there is a browser."""
    say_path(console, what, page)
    if wanted:
        import webbrowser

        if not webbrowser.open(page.resolve().as_uri()):
            console.print("No browser was found; open the page above in one.", highlight=False)

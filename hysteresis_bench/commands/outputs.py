"""What a command may write over: nothing that was there before, but its own earlier results."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click

from hysteresis_bench.errors import UserError

REPORT, CONTINUED = "report.html", ("trials.sqlite", "cases")
"""A study's page, and what a study or a study of diagnosis goes on from."""
UNFINISHED = "unfinished.jsonl"
"""What a command that was stopped goes on from; beside it, what it had begun to write is its own."""
CLOSING = "closing.json"
"""What a study keeps beside the diagnosis at its end."""

TABLES = (".csv", ".txt", ".dat")
"""What a file of text with commas may be called: by its name a file is read."""

plot_option = click.option(
    "--plot", type=click.Path(path_type=Path, dir_okay=False), help="Draw it for a paper: .pdf, .svg or .png."
)
force_option = click.option("--force", is_flag=True, help="Write over what is there, also over the inputs.")


def check_file(out: Path, inputs: Sequence[Path] = (), force: bool = False) -> None:
    """Raises UserError where a file cannot be written, or would replace one without `force`."""
    if not out.parent.is_dir():
        raise UserError(str(out), f"there is no folder {out.parent} to write it to.")
    _check_writable(out.parent)
    if out.exists() and (out.is_fifo() or out.is_dir()):
        raise UserError(str(out), "is no file that can be written.")
    if any(_same(out, file) for file in inputs) and not force:
        raise UserError(str(out), "is one of the inputs; choose another name, or --force to replace it.")
    if out.is_file() and not force:
        raise UserError(str(out), "is there already; choose another name, or --force to replace it.")


def check_table(out: Path, inputs: Sequence[Path] = (), force: bool = False) -> None:
    """`check_file` of a CSV. Raises UserError, too, for the name of another kind of file, which nothing would open."""
    if out.suffix.lower() not in TABLES:
        such = out.with_suffix(".csv").name
        raise UserError(str(out), f"what is written is CSV, so give it a name that ends in .csv, such as {such}.")
    check_file(out, inputs, force)


def check_plot(plot: Path | None, inputs: Sequence[Path] = (), force: bool = False) -> None:
    """Raises UserError now for a figure that could not be drawn at the end, or would replace a file; None is well."""
    from hysteresis_bench.report.shared.papers import check_figure

    if plot is not None:
        check_figure(plot)
        check_file(plot, inputs, force)


def check_folder(
    folder: Path, files: Sequence[str], page: str, inputs: Sequence[Path] = (), force: bool = False
) -> None:
    """Raises UserError where files of a folder would replace an input, or what another command left there.

    files : that will be written;  page : one of them, which says that the folder is the command's own
    """
    _check_writable(folder)
    if force:
        return
    faults = [f"{file} is one of the inputs." for file in inputs for name in files if _same(folder / name, file)]
    own = (folder / page).is_file() or (folder / UNFINISHED).is_file()
    if not own or (folder / CLOSING).is_file():
        faults += [f"{folder / name} is not this command's own." for name in files if (folder / name).exists()]
    if faults:
        raise UserError(str(folder), [*faults, "Choose another folder with --out, or --force to replace them."])


def check_results(folder: Path, force: bool = False) -> None:
    """Raises UserError for a report that is kept without what it was made from: running would begin it anew."""
    continued = any((folder / name).exists() for name in CONTINUED)
    if (folder / REPORT).is_file() and not continued and not force:
        raise UserError(
            str(folder),
            "holds a report that is kept, without its trials, and would be replaced. "
            "Choose another folder with --out, or --force to replace it.",
        )


def _check_writable(folder: Path) -> None:
    """Raises UserError now where a folder could not be written, or made, at the end."""
    there = next(one for one in (folder, *folder.absolute().parents) if one.exists())
    if not there.is_dir():
        raise UserError(str(folder), f"cannot be made: {there} is no folder. Choose another one with --out.")
    if not os.access(there, os.W_OK | os.X_OK):
        raise UserError(str(folder), f"cannot be written: {there} is read-only. Choose another place with --out.")


def _same(one: Path, other: Path) -> bool:
    return one.exists() and other.exists() and one.samefile(other)

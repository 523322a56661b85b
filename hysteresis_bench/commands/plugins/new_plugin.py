"""The command `new-plugin`: an installable distribution with one working plugin, and a test that passes."""

from __future__ import annotations

from pathlib import Path

import click

from hysteresis_bench.commands.plugins.check_plugin import SINGULAR
from hysteresis_bench.commands.terminal.console import plain_console, say_path
from hysteresis_bench.errors import UserError


@click.command("new-plugin")
@click.argument("kind", type=click.Choice(list(SINGULAR)))
@click.argument("name")
@click.option("--out", type=click.Path(path_type=Path), help="The folder to write.  [default: hysteresis-bench-NAME]")
def new_plugin(kind: str, name: str, out: Path | None) -> None:
    """Write a distribution with a plugin of this KIND and NAME: change the example in it to what you want."""
    from hysteresis_bench.testing.scaffold.write import distribution_of, files, name_faults

    if faults := name_faults(SINGULAR[kind], name):
        raise UserError("new-plugin", faults)
    folder = out or Path(distribution_of(name))
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise UserError(str(folder), "is there already. Choose another folder with --out.")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for file, text in files(SINGULAR[kind], name).items():
            (folder / file).write_text(text, encoding="utf-8")
    except OSError as error:
        raise UserError(str(folder), f"cannot be written: {error.strerror}.") from None
    console = plain_console()
    say_path(console, kind, folder)
    console.print(
        f"next: pip install --editable {folder}, then hysteresis-bench check-plugin {name}",
        highlight=False,
        markup=False,
        soft_wrap=True,
    )

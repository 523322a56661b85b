"""The command `list`: what is registered, what is broken and why, and the studies of this folder."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import plain_console
from hysteresis_bench.errors import UserError, nearest

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from hysteresis_bench import registry

KINDS: tuple[registry.Kind, ...] = ("models", "effects", "optimizers", "rigs")


@click.command("list")
@click.argument("what", required=False)
@json_option
def list_plugins(what: str | None, as_json: bool) -> None:
    """List models, effects, optimizers, rigs or studies; all of them without an argument. With the name of a plugin
    tell what it is: parameters, settings, and where it comes from."""
    from hysteresis_bench import registry
    from hysteresis_bench.commands.plugins.describe import describe, kinds_of, told_of

    known = (*KINDS, "studies")
    console = plain_console()
    if what is not None and what not in known:
        if not kinds_of(what):
            everything = {*known, *registry.offered(), *(name for kind in KINDS for name in registry.names(kind))}
            raise UserError("list", f'there are no "{what}". {_nearest(what, known, everything)}')
        if as_json:
            say_json([told_of(kind, what) for kind in kinds_of(what)])
            return
        describe(what, console)
        return
    if as_json:
        say_json({kind: _rows(kind) for kind in KINDS if what in (None, kind)})
        return
    for kind in KINDS:
        if what in (None, kind):
            _list_kind(kind, console)
    if what in (None, "studies"):
        _list_studies(console)


def _rows(kind: registry.Kind) -> list[dict[str, str]]:
    """The plugins of a kind, for programs."""
    from hysteresis_bench import registry

    return [
        {"name": one.name, "summary": _by_itself(one.summary), "distribution": one.distribution, "version": one.version}
        | ({"fault": one.fault} if one.fault else {})
        for one in registry.registered(kind)
    ]


def _by_itself(summary: str) -> str:
    """Without the numbers of references, which a plugin tells in full by its name."""
    return re.sub(r" \[[0-9]+\](?=[.,;: ])", "", summary)


def _nearest(what: str, kinds: tuple[str, ...], everything: set[str]) -> str:
    """The kinds that can be listed, and what was meant among all names."""
    told, _, meant = nearest(what, everything).partition(". ")
    return f"Known: {', '.join(kinds)}, or the name of a plugin. {meant}" if told else ""


def _list_kind(kind: registry.Kind, console: Console) -> None:
    from rich.markup import escape

    from hysteresis_bench import registry

    table = _table(kind)
    for plugin in registry.registered(kind):
        summary = _by_itself(plugin.summary)
        if kind == "rigs" and plugin.loaded is not None:
            summary += f" Experiments: {', '.join(plugin.loaded.experiments)}."  # type: ignore[attr-defined]
        origin = f"{plugin.distribution} {plugin.version}"
        table.add_row(f"  {plugin.name}", escape(summary), escape(origin), style="red" if plugin.fault else "")
    if kind == "effects":
        for name, models in registry.offered().items():
            effect = registry.load("models", models[0]).loaded.offers[name]  # type: ignore[union-attr]
            table.add_row(
                f"  {name}", escape(f"{_by_itself(registry.sentence(type(effect)))} For {', '.join(models)}.")
            )
    console.print(table)


def _list_studies(console: Console) -> None:
    import tomllib

    from rich.markup import escape

    table = _table("studies")
    for path in sorted(Path("studies").glob("*.toml")):
        if path.name.endswith(".published.toml"):
            continue
        try:
            title = str(tomllib.loads(path.read_text(encoding="utf-8")).get("title", ""))
        except (OSError, tomllib.TOMLDecodeError) as error:
            title = f"broken: {error}"
        table.add_row(f"  {path}", escape(title))
    if not table.row_count:
        table.add_row("  none", "there is no folder studies/ here")
    console.print(table)


def _table(title: str) -> Table:
    from rich.table import Table

    table = Table(title=title, title_justify="left", box=None, pad_edge=False, title_style="bold", show_header=False)
    table.add_column(no_wrap=True)  # a name is there to be copied
    return table

"""The command `check-plugin`: the contract tests on one registered plugin, and why each failed one did."""

from __future__ import annotations

import sys
from dataclasses import asdict
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.data.finite import finite
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import plain_console
from hysteresis_bench.errors import UserError, nearest

if TYPE_CHECKING:
    from rich.console import Console

    from hysteresis_bench import registry
    from hysteresis_bench.testing.check import Verdict

SINGULAR: dict[str, registry.Kind] = {
    "optimizer": "optimizers",
    "model": "models",
    "effect": "effects",
    "rig": "rigs",
}
FAILED = 1
LONGEST_TIMEOUT = 1e6
"""Seconds that a test may take; a timer of the system takes no number of them beyond."""


@click.command("check-plugin")
@click.argument("name")
@click.option("--kind", type=click.Choice(list(SINGULAR)), help="Where a name is of several kinds.")
@click.option(
    "--timeout",
    type=click.FloatRange(min=0, min_open=True, max=LONGEST_TIMEOUT),
    callback=finite,
    default=120.0,
    show_default=True,
    help="Seconds a test, compilation not counted.",
)
@json_option
def check_plugin(name: str, kind: str | None, timeout: float, as_json: bool) -> None:
    """Test whether the plugin NAME keeps its contract; exit code 1 where it does not."""
    from hysteresis_bench import registry
    from hysteresis_bench.testing.check import BROKEN

    asked = {word: SINGULAR[word] for word in ([kind] if kind else SINGULAR)}
    found = {word: one for word, one in asked.items() if name in registry.names(one)}
    if not found:
        known = [other for one in asked.values() for other in registry.names(one)]
        raise UserError("check-plugin", f'no {kind or "plugin"} "{name}". {nearest(name, known)}')
    console = plain_console(aside=as_json)
    verdicts = {word: _check(console, word, one, name, timeout) for word, one in found.items()}
    if as_json:
        say_json([{"kind": word, "name": name, **asdict(one)} for word, told in verdicts.items() for one in told])
    if any(verdict.status == BROKEN for told in verdicts.values() for verdict in told):
        sys.exit(FAILED)


def _check(console: Console, word: str, kind: registry.Kind, name: str, timeout: float) -> list[Verdict]:
    """Print one line a promise."""
    from rich.markup import escape

    from hysteresis_bench import registry
    from hysteresis_bench.commands.terminal.steps import steps_told
    from hysteresis_bench.testing.check import BROKEN, check

    plugin = registry.load(kind, name)
    console.print(f"[bold]{word} {escape(name)}[/] of {escape(plugin.distribution)} {escape(plugin.version)}")
    with steps_told("check-plugin") as on_step:
        verdicts = list(check(kind, name, timeout, on_step))
    for verdict in verdicts:
        if verdict.status == BROKEN:
            console.print(f"  [red]broken[/]  {escape(verdict.promise)}", highlight=False)
            console.print(f"          [red]{escape(verdict.reason)}[/]", highlight=False, soft_wrap=True)
        elif verdict.reason:
            console.print(f"  {verdict.promise}: {escape(verdict.reason)}", highlight=False, soft_wrap=True)
        else:
            console.print(f"  kept    {escape(verdict.promise)}", highlight=False)
    broken = sum(verdict.status == BROKEN for verdict in verdicts)
    told = f"{broken} of {len(verdicts)} promises are broken." if broken else "Every promise is kept."
    console.print(told, highlight=False)
    return verdicts

"""One plugin on the terminal: its docstring, parameters, settings, and where it comes from."""

from __future__ import annotations

import dataclasses
import inspect
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from hysteresis_bench import registry
from hysteresis_bench.parameters import Parameter

KINDS: tuple[registry.Kind, ...] = ("models", "effects", "optimizers", "rigs")
UNITS = {"input": "input", "output": "output", "time": "time"}


def kinds_of(name: str) -> tuple[registry.Kind, ...]:
    """The kinds in which a name is registered; effects that models offer are effects."""
    offered: tuple[registry.Kind, ...] = ("effects",) if name in registry.offered() else ()
    return tuple(kind for kind in KINDS if name in registry.names(kind)) or offered


def describe(name: str, console: Console) -> None:
    """Print what a plugin of this name is, in each kind that has one."""
    for kind in kinds_of(name):
        if name not in registry.names(kind):
            models = registry.offered()[name]
            _describe_class(f"effect {name}, offered by {', '.join(models)}", registry.effect(name), console)
            continue
        plugin = registry.load(kind, name)
        title = f"{kind[:-1]} {name} of {plugin.distribution} {plugin.version}"
        if plugin.loaded is None:
            console.print(f"[bold]{escape(title)}[/]\n[red]{escape(plugin.summary)}[/]", highlight=False)
        else:
            _describe_class(title, plugin.loaded, console)


def _describe_class(title: str, loaded: type, console: Console) -> None:
    console.print(f"[bold]{escape(title)}[/]", highlight=False)
    console.print(escape(inspect.getdoc(loaded) or ""), highlight=False)
    if parameters := getattr(loaded, "parameters", ()):
        console.print(_parameters(parameters))
    if settings := registry.settings_of(loaded):
        console.print(_settings(loaded, settings))
    if experiments := getattr(loaded, "experiments", {}):
        table = _table("experiment", "")
        for experiment, line in experiments.items():
            table.add_row(experiment, escape(line))
        console.print(table)
    console.print(f"source: {inspect.getsourcefile(loaded)}", highlight=False, soft_wrap=True)


def _parameters(parameters: tuple[Parameter, ...]) -> Table:
    table = _table("parameter", "unit", "box", "scaling", "null", "")
    for one in parameters:
        null = "" if one.null is None else f"{one.null:g}"
        box = f"{one.lower:g} to {one.upper:g}"
        table.add_row(one.name, escape(one.unit_in(UNITS)), box, one.scaling, null, escape(one.meaning))
    return table


def _settings(loaded: type, types: dict[str, Any]) -> Table:
    table = _table("setting", "type", "default")
    for field in dataclasses.fields(loaded):
        if field.name in types:
            default = field.default if field.default_factory is dataclasses.MISSING else field.default_factory()
            kind = types[field.name]
            table.add_row(field.name, escape(getattr(kind, "__name__", str(kind))), escape(repr(default)))
    return table


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 2, 0, 0))
    for column in columns:
        table.add_column(column)
    return table


def told_of(kind: registry.Kind, name: str) -> dict[str, Any]:
    """What `describe` prints, for programs: docstring, parameters with their boxes, source."""
    offered = name not in registry.names(kind)
    plugin = None if offered else registry.load(kind, name)
    loaded = registry.effect(name) if offered else plugin and plugin.loaded
    parameters = [dataclasses.asdict(one) for one in getattr(loaded, "parameters", ())]
    return {
        "kind": kind[:-1],
        "name": name,
        "says": inspect.getdoc(loaded) or "",
        "parameters": parameters,
        "source": f"{plugin.distribution} {plugin.version}" if plugin else f"offered by {registry.offered()[name]}",
    }

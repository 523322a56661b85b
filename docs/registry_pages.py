"""Pages that are made from what is registered: models, effects, optimizers, rigs, commands."""

from __future__ import annotations

import dataclasses
import re
import sys
from collections.abc import Iterable, Sequence
from typing import Any

import click

from docs.docstrings import markdown
from hysteresis_bench import registry
from hysteresis_bench.cli import main
from hysteresis_bench.free_forms import FreeForm
from hysteresis_bench.parameters import Parameter

OURS = "hysteresis-bench"
"""The distribution whose plugins are shown; what else is installed here is no part of the documentation."""

INTRODUCTIONS: dict[registry.Kind, str] = {
    "models": "A model turns an input over time into an output over time. `hysteresis-bench list models` shows these "
    "and whatever else is installed; [Writing plugins](plugins.md) says how to add one.",
    "effects": "An effect wraps a model and is fitted with it; at its null value it changes nothing. "
    "[Diagnosis](diagnosis.md) says how it is found out whether the data ask for one.",
    "optimizers": "An optimizer searches the unit box until its budget of evaluations is spent. "
    "[Which optimizer](which.md) says what the kept studies found.",
    "rigs": "A rig is a virtual test bench: a physical simulation that stands in for an actuator. What is hidden in "
    "its data is known, so that a diagnosis can be checked.",
}


def page(kind: registry.Kind) -> str:
    """The page of a kind of plugin, in Markdown."""
    parts = [f"# {kind.capitalize()}", INTRODUCTIONS[kind]]
    for name, loaded in _effects().items() if kind == "effects" else _shipped(kind).items():
        parts += _plugin(kind, name, loaded)
    return "\n\n".join(parts) + "\n"


def _shipped(kind: registry.Kind) -> dict[str, Any]:
    """Our own plugins of a kind, by name."""
    plugins = [registry.load(kind, name) for name in registry.names(kind)]
    return {plugin.name: plugin.loaded for plugin in plugins if plugin.distribution == OURS and plugin.loaded}


def _effects() -> dict[str, Any]:
    """Effects around models, and those that models offer inside their state equations."""
    models = _shipped("models")
    inside = {name: models[offering[0]].offers[name] for name, offering in registry.offered().items()}
    return {**_shipped("effects"), **{name: type(effect) for name, effect in inside.items()}}


def _plugin(kind: registry.Kind, name: str, loaded: Any) -> list[str]:
    parts = [f"## {name}", markdown(loaded.__doc__ or "")]
    if kind == "effects":
        parts.append(_acts(name, loaded))
    if kind in ("models", "effects"):
        parts.append(_parameters(loaded.parameters))
        parts += _mistaken_for(name, loaded) if kind == "effects" else []
        parts += _offers(loaded) if kind == "models" else []
    if kind == "rigs":
        parts.append(table(["experiment", "what is measured"], loaded.experiments.items()))
    parts.append(_settings(loaded))
    if kind in ("models", "optimizers"):
        parts += _module(loaded)
    return [part for part in parts if part]


def _module(loaded: Any) -> list[str]:
    """What the plugin's file says beyond its first sentence: equations, legend, sources."""
    said = (sys.modules[loaded.__module__].__doc__ or "").strip().partition("\n\n")[2]
    return ["From its file:", markdown(said)] if said else []


def _acts(name: str, effect: Any) -> str:
    words = f"Acts: {effect.acts}. Family: {effect.family}."
    if name in registry.offered():
        models = ", ".join(f"[{model}](models.md#{model})" for model in registry.offered()[name])
        words += f" It stands inside the state equation of {models}."
    words += " A free form: it stands for its family where no formula fits." if issubclass(effect, FreeForm) else ""
    return f"{words} A nuisance: it is estimated and never claimed." if effect.nuisance else words


def _mistaken_for(name: str, effect: Any) -> list[str]:
    """What the effect says itself, and what others say of it: it is enough for one of the two."""
    reasons = {other: own.mistaken_for[name] for other, own in _effects().items() if name in own.mistaken_for}
    rows = [(f"`{other}`", reason) for other, reason in sorted({**reasons, **effect.mistaken_for}.items())]
    return [table(["may be mistaken for", "because"], rows)] if rows else []


def _offers(model: Any) -> list[str]:
    names = ", ".join(f"[{name}](effects.md#{name})" for name in model.offers)
    return [f"Offers inside its state equation: {names}."] if names else []


def _parameters(parameters: Sequence[Parameter]) -> str:
    rows = [
        (
            f"`{p.name}`",
            p.meaning,
            f"`{p.unit}`",
            f"{p.lower:g} to {p.upper:g}, {p.scaling}",
            "" if p.null is None else f"{p.null:g}",
        )
        for p in parameters
    ]
    return table(["parameter", "meaning", "unit", "default box", "off at"], rows) if rows else "No parameters."


def _settings(loaded: Any) -> str:
    if not dataclasses.is_dataclass(loaded):
        return ""
    fields = [field for field in dataclasses.fields(loaded) if field.init]
    rows = [(f"`{field.name}`", f"`{field.type}`", f"`{_default(field)}`") for field in fields]
    return table(["setting", "type", "default"], rows) if rows else ""


def _default(field: dataclasses.Field[Any]) -> Any:
    return field.default_factory() if field.default is dataclasses.MISSING else field.default  # type: ignore[misc]


def commands() -> str:
    """The page of the command line, in Markdown."""
    parts = [
        "# Commands",
        "`hysteresis-bench COMMAND --help` tells the same. `python -m hysteresis_bench` is the same program. "
        "Exit codes: 0 done, 1 done with failed trials, 2 your input is at fault (one message, no traceback).",
    ]
    for name, command in sorted(main.commands.items()):
        context = click.Context(command, info_name=f"hysteresis-bench {name}")
        usage = command.get_usage(context).removeprefix("Usage: ")
        shown = [o for o in command.params if isinstance(o, click.Option) and not o.hidden]
        rows = [(f"`{', '.join(o.opts)}{_value(o)}`", f"{o.help or ''}{_unsaid(o)}") for o in shown]
        parts += [f"## {name}", command.help or "", f"```text\n{' '.join(usage.split())}\n```"]
        parts += [table(["option", ""], rows)] if rows else []
    return "\n\n".join(parts) + "\n"


def _value(option: click.Option) -> str:
    return "" if option.is_flag else f" {option.make_metavar(click.Context(click.Command('')))}"


def _unsaid(option: click.Option) -> str:
    """The default, where the help does not say it itself."""
    return f" Default: `{option.default}`." if option.show_default else ""


def table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A Markdown table; the cells' own bars are taken as they stand, in code without a backslash before them."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(_barred(str(cell)) for cell in line) + " |" for line in lines)


def _barred(cell: str) -> str:
    return re.sub(r"(`[^`]*`)|\|", lambda found: found[1] or r"\|", cell)

"""Entry points to plugins: the only door to them. Loaded lazily; a broken plugin is listed with its fault."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Literal

from hysteresis_bench.contracts import Effect, Model, Optimizer, Rig
from hysteresis_bench.declarations import declaration_faults
from hysteresis_bench.errors import nearest, told

Kind = Literal["models", "effects", "optimizers", "rigs"]
CONTRACTS: dict[Kind, type] = {"models": Model, "effects": Effect, "optimizers": Optimizer, "rigs": Rig}

SHIPPED = "hysteresis-bench"
"""The distribution of the framework and of the plugins that come with it."""

# The defaults: the only names of plugins that the framework itself knows.
SEARCH = "multistart-least-squares"
"""The search of a fit where none is asked for: it finds the best known optimum of 200 Bouc-Wen and 60 Jiles-Atherton
truths in a median of 280 and 590 evaluations, where the swarms use their 15 050 (`benchmarks/search.py`)."""
REFERENCE = "pso"
"""What a study compares its optimizers with where it says nothing else."""
RANDOM_SEARCH = "random-search"
"""What every search must beat: the yardstick of a study's figures."""
COMMON_OFFSET = "bias"
"""The effect that adds one constant to all records."""
RECORD_OFFSET = "record-offset"
"""The effect that estimates one constant a record: what every diagnosis begins with."""
OFFSETS = (COMMON_OFFSET, RECORD_OFFSET)
DESCRIPTION = "description"
"""The effect that adds accepted terms to the output: a description, and no physics."""
BOUC_WEN, HAMMERSTEIN = "bouc-wen", "hammerstein"
"""The models whose inverse `control` knows: hysteresis alone, and with a linear section behind it."""


LARGEST_INTEGER = 2**63 - 1
"""Of a setting: beyond it, Python's integers are no numbers of an array."""


@dataclass(frozen=True)
class Plugin:
    """A registered name, what it is, and where it comes from.

    distribution : the installed package that registers it, as pip names it;  version : of that
    fault : why it cannot be used, or an empty string
    """

    kind: Kind
    name: str
    distribution: str
    version: str
    loaded: type | None
    fault: str = ""

    @property
    def shipped(self) -> bool:
        """Whether it came with the framework."""
        return self.distribution == SHIPPED

    @property
    def summary(self) -> str:
        """The first sentence of the plugin's docstring, or its fault."""
        return f"broken: {self.fault}" if self.loaded is None else sentence(self.loaded)


def sentence(plugin: type) -> str:
    """The first paragraph of a docstring, on one line."""
    return " ".join((plugin.__doc__ or "").split("\n\n")[0].split())


@dataclass(frozen=True)
class _Point:
    """An entry point, and the distribution that registers it."""

    entry: EntryPoint
    distribution: str
    version: str


@cache
def _points() -> Mapping[Kind, Mapping[str, tuple[_Point, ...]]]:
    """By kind and name; more than one where several distributions register the same."""
    every = entry_points()  # reads a file of every installed distribution: asked once for all kinds
    homes: dict[int, tuple[str, str]] = {}
    found: dict[Kind, dict[str, tuple[_Point, ...]]] = {kind: {} for kind in CONTRACTS}
    for kind, of_kind in found.items():
        for entry in every.select(group=f"hysteresis_bench.{kind}"):
            if id(entry.dist) not in homes:
                homes[id(entry.dist)] = (entry.dist.name, entry.dist.version) if entry.dist else ("", "")
            point = _Point(entry, *homes[id(entry.dist)])
            of_kind[entry.name] = (*of_kind.get(entry.name, ()), point)
    return found


def names(kind: Kind) -> tuple[str, ...]:
    """Every registered name, sorted; nothing is loaded."""
    return tuple(sorted(_points()[kind]))


def usable(kind: Kind) -> tuple[str, ...]:
    """Names of those that can be loaded, sorted; `list` tells what is wrong with the others."""
    return tuple(name for name in names(kind) if not load(kind, name).fault)


def registered(kind: Kind) -> tuple[Plugin, ...]:
    """Every plugin, loaded, by name; all those that share one, each with its fault."""
    return tuple(_loaded(kind, name, point) for name in names(kind) for point in _points()[kind][name])


def load(kind: Kind, name: str) -> Plugin:
    """Load one plugin; a plugin that cannot be loaded carries its fault. Raises KeyError if unknown."""
    if name not in _points()[kind]:
        raise KeyError(f'no {kind[:-1]} "{name}". {nearest(name, names(kind))}')
    return _loaded(kind, name, _points()[kind][name][0])


def _loaded(kind: Kind, name: str, point: _Point) -> Plugin:
    loaded, fault = _checked(kind, name, point.entry)
    return Plugin(kind, name, point.distribution, point.version, loaded, fault)


def _checked(kind: Kind, name: str, point: EntryPoint) -> tuple[type | None, str]:
    """What an entry point leads to, or why it cannot be used."""
    homes = [f"{each.distribution} {each.version}" for each in _points()[kind][name]]
    if len(homes) > 1:
        return None, f"registered by {' and by '.join(homes)}; uninstall all but one of them"
    try:
        loaded = point.load()
    except (Exception, SystemExit) as error:  # a plugin's own fault, whatever it is, must not stop the others
        return None, told(error)
    if found := declaration_faults(loaded, CONTRACTS[kind]):
        return None, " · ".join(found)
    return loaded, ""


@cache
def offered() -> Mapping[str, tuple[str, ...]]:
    """Effects that act inside models: their names, and the models that offer them."""
    found: dict[str, tuple[str, ...]] = {}
    for model in names("models"):
        plugin = load("models", model)
        for effect in plugin.loaded.offers if plugin.loaded else ():  # type: ignore[attr-defined]
            found[effect] = (*found.get(effect, ()), model)
    return found


@cache
def effect(name: str) -> type[Effect]:
    """What declares an effect, also of one inside models. Raises KeyError if unknown, ValueError if broken."""
    if name in offered() and name not in _points()["effects"]:
        return type(load("models", offered()[name][0]).loaded.offers[name])  # type: ignore[union-attr]
    plugin = load("effects", name)
    if plugin.loaded is None:
        raise ValueError(f'effect "{name}" is broken: {plugin.fault}')
    return plugin.loaded


def faults(kind: Kind, name: str, settings: Mapping[str, Any]) -> list[str]:
    """What is wrong with a plugin's name or settings, a sentence each; empty when nothing is."""
    if name not in _points()[kind]:
        return [f'no {kind[:-1]} "{name}". {nearest(name, names(kind))}']
    plugin = load(kind, name)
    if plugin.loaded is None:
        return [f'{kind[:-1]} "{name}" is broken: {plugin.fault}']
    fields = settings_of(plugin.loaded)
    found = []
    for key, value in settings.items():
        if key not in fields:
            found.append(f'{name} has no setting "{key}". {nearest(key, fields)}')
        elif not _fits(value, fields[key]):
            expected = getattr(fields[key], "__name__", str(fields[key]))
            found.append(f"{name}: {key} = {value!r} must be of type {expected}.")
    if not found:
        try:
            plugin.loaded(**settings)
        except ValueError as error:
            found.append(f"{name}: {error}")
    return found


def build(kind: Kind, name: str, settings: Mapping[str, Any] | None = None) -> Any:
    """A plugin with its settings. Raises ValueError that tells all faults at once."""
    found = faults(kind, name, settings or {})
    if found:
        raise ValueError(" · ".join(found))
    loaded = load(kind, name).loaded
    assert loaded is not None
    return loaded(**(settings or {}))


def effect_faults(effect: str, model: str) -> list[str]:
    """What is wrong with an effect around a model, both by name, a sentence each; empty when nothing is."""
    if effect in _points()["effects"]:
        return faults("effects", effect, {})
    if effect not in offered():
        return [f'no effect "{effect}". {nearest(effect, (*names("effects"), *offered()))}']
    if model in _points()["models"] and model not in offered()[effect]:
        return [f"{model} has no room for {effect}; models that offer it: {', '.join(offered()[effect])}."]
    return []


def build_effects(
    model: Model, effects: Iterable[str], settings: Mapping[str, Mapping[str, Any]] | None = None
) -> tuple[tuple[str, Effect], ...]:
    """Effects by name as they go around a model: those that it offers are its own. settings : by the effect's name.
    Raises ValueError for an effect that neither is registered nor has room in the model."""
    told = settings or {}
    # offered() loads every model, also those of other distributions: asked last
    homeless = [name for name in effects if name not in (*model.offers, *_points()["effects"]) and name in offered()]
    if homeless:
        name = homeless[0]
        raise ValueError(f"the model has no room for {name}; models that offer it: {', '.join(offered()[name])}.")
    return tuple(
        (name, model.offers[name] if name in model.offers else build("effects", name, told.get(name)))
        for name in effects
    )


def settings_of(plugin: type) -> dict[str, Any]:
    """Names and types of a plugin's settings: the fields of its dataclass."""
    if not dataclasses.is_dataclass(plugin):
        return {}
    hints = typing.get_type_hints(plugin)
    return {field.name: hints[field.name] for field in dataclasses.fields(plugin) if field.init}


def _fits(value: Any, expected: Any) -> bool:
    """Is the value of the type, an integer also where a float is wanted?"""
    options = typing.get_args(expected) if typing.get_origin(expected) is not None else (expected,)
    if typing.get_origin(expected) is Literal:
        return value in options
    if typing.get_origin(expected) in (tuple, list, dict):
        return isinstance(value, (list, tuple, dict))
    if isinstance(value, bool):
        return bool in options
    allowed = tuple(option for option in options if isinstance(option, type))
    if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        return False
    return isinstance(value, allowed) or (float in allowed and isinstance(value, int))

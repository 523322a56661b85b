"""A fitted model as a chain of parts, each of which goes on by one sample."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import entry_points
from types import ModuleType
from typing import Any

from hysteresis_bench.contracts import Part
from hysteresis_bench.errors import UserError, told
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.signals import INDEX

GROUP = "hysteresis_bench.exports"


@dataclass(frozen=True, eq=False)
class Link:
    """A part of the chain: its plugin's name, its module of functions, where its state and its constants begin."""

    name: str
    module: ModuleType
    part: Part
    state: int
    constants: int

    def function(self, name: str) -> Callable[..., Any] | None:
        found: Callable[..., Any] | None = getattr(self.module, name, None)
        return found


@dataclass(frozen=True, eq=False)
class Chain:
    """A fitted model, ready to be written in another language.

    law : the model;  effects : around it, innermost first, those that do something
    ignored : effects that the inverse leaves out, None where there is no inverse
    """

    fitted: FittedModel
    law: Link
    effects: tuple[Link, ...]
    ignored: tuple[str, ...] | None

    @property
    def links(self) -> tuple[Link, ...]:
        return (self.law, *self.effects)

    @property
    def constants(self) -> list[float]:
        return [value for link in self.links for value in link.part.constants]

    @property
    def state(self) -> int:
        return sum(link.part.state for link in self.links)

    @property
    def roots(self) -> list[Callable[..., Any]]:
        """The functions that the model calls itself."""
        back = self.ignored is not None
        return [
            found
            for link in self.links
            for name in ("before", "law", "after", *(("inverse", "undone") if back and link.part.invertible else ()))
            if (found := link.function(name)) is not None
        ]


def chain_of(fitted: FittedModel) -> Chain:
    """Raises UserError telling every plugin of the model that cannot be exported, and why."""
    system = fitted.system
    values = {**fitted.fixed, **{name: estimate.value for name, estimate in fitted.parameters.items()}}
    timed = fitted.units.get("time") != INDEX
    faults: list[str] = []
    links: list[Link] = []
    state = constants = 0
    for kind, name, plugin in (("model", fitted.model, system.model), *(("effect", *one) for one in system.effects)):
        prefix = "" if kind == "model" else name
        own = {key.rpartition(".")[2]: value for key, value in values.items() if key.rpartition(".")[0] == prefix}
        try:
            found = _part(name, plugin, own, timed, inside=kind == "effect" and name in system.model.offers)
        except ValueError as error:
            faults.append(f"{kind} {name} cannot be exported: {error}.")
            continue
        if found is not None:
            links.append(Link(name, found[0], found[1], state, constants))
            state, constants = state + found[1].state, constants + len(found[1].constants)
    if faults:
        raise UserError("export", faults)
    law, *effects = links
    ignored = None
    if law.part.invertible:
        ignored = tuple(link.name for link in effects if not link.part.invertible)
    return Chain(fitted, law, tuple(effects), ignored)


def _part(
    name: str, plugin: Any, values: Mapping[str, float], timed: bool, *, inside: bool
) -> tuple[ModuleType, Part] | None:
    """Its module and its part, None where it changes nothing. Raises ValueError saying why it cannot be exported."""
    if inside:
        raise ValueError("it acts inside the model's own equation, which has no form of one sample at a time")
    known = list(entry_points(group=GROUP, name=name))
    if not known:
        raise ValueError(f"its distribution registers nothing for it in the group {GROUP}")
    try:
        make = known[0].load()
    except Exception as error:  # a third party's module raises whatever it likes
        raise ValueError(told(error)) from None
    made = make(plugin, values, timed)
    return None if made is None else (import_module(known[0].module), made)

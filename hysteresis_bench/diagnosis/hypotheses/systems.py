"""Where an effect belongs in the stack around a model, and which effects can be tried on given records."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import get_args

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Acts, Effect, Family, Model
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.fit.checks.redundant import is_redundant
from hysteresis_bench.fit.checks.wanted_units import unlike_wanted
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.smooth.rough import Rough, solvable
from hysteresis_bench.free_forms import FreeForm
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record


def place(name: str, effect: type[Effect]) -> tuple[int, bool, int, str]:
    """Sorts effects from the innermost to the outermost, by what they declare: where they act, nuisances last, then
    their family, then the alphabet."""
    return get_args(Acts).index(effect.acts), effect.nuisance, get_args(Family).index(effect.family), name


def is_curve(effect: Effect | type[Effect]) -> bool:
    """Is its family the curve of the input, of the output, or beside the law?"""
    return effect.family.startswith("curve")


@dataclass(frozen=True, eq=False)
class Stack:
    """A model, and systems made of it and of effects given by name; the records that are fitted.

    own : effects that the user put around the model to begin with, always there
    bounds : replaces parts of the boxes that follow from the records
    fixed : parameters that are known
    ready : effects with settings of their own, by name
    """

    model: Model
    records: tuple[Record, ...]
    own: tuple[str, ...] = ()
    bounds: Mapping[str, tuple[float, float]] | None = None
    fixed: Mapping[str, float] | None = None
    ready: Mapping[str, Effect] = field(default_factory=dict)

    def effect(self, name: str) -> Effect:
        """An effect, with its default settings where none is ready: the model's own, where it offers one of this
        name."""
        if name in self.ready:
            return self.ready[name]
        return self.model.offers[name] if name in self.model.offers else _built(name)

    def system(self, names: Collection[str]) -> System:
        """The model with these effects in their places."""
        around = [(name, self.effect(name)) for name in {*names, *self.own}]
        around.sort(key=lambda one: place(one[0], type(one[1])))
        return System(self.model, tuple(around), {**(self.fixed or {}), **self._ranges(around)})

    def _ranges(self, around: Sequence[tuple[str, Effect]]) -> dict[str, float]:
        """What the records tell the free forms of their range, in the middle of its box."""
        return {
            f"{name}.{p.name}": 0.5 * (p.lower + p.upper)
            for name, effect in around
            if isinstance(effect, FreeForm)
            for p in effect.box(self.records)
            if p.name in effect.ranges
        }

    def problem(self, names: Collection[str]) -> Problem:
        """Their least-squares problem; boxes follow from the fitted records."""
        key = frozenset(names)
        if key not in self._problems:
            self._problems[key] = self._problem(key)
        return self._problems[key]

    @cached_property
    def _problems(self) -> dict[frozenset[str], Problem]:
        return {}

    def _problem(self, names: frozenset[str]) -> Problem:
        system = self.system(names)
        boxes = [
            p.bounded(*self.bounds[p.name]) if self.bounds and p.name in self.bounds else p
            for p in system.box(self.records)
        ]
        return Problem(system, self.records, Space(tuple(boxes)), LOSSES["rmse"])

    def candidates(self) -> tuple[tuple[str, ...], dict[str, str]]:
        """Names of the effects that can be tried, and of those that cannot, with the reason."""
        possible, impossible = [], {}
        known = {*registry.names("effects"), *registry.offered()}
        for name in sorted(known - {*self.own}):
            if name not in self.model.offers and name not in registry.names("effects"):
                impossible[name] = "it acts inside the state equation, and this model does not offer it"
            elif name not in self.model.offers and (fault := registry.load("effects", name).fault):
                impossible[name] = f"broken: {fault}"
            elif self.effect(name).nuisance or isinstance(self.effect(name), FreeForm):
                continue
            elif reason := self._inapplicable(name):
                impossible[name] = reason
            elif not self._solvable(name):
                impossible[name] = "behind it the output is not linear in the law's many weights, which are solved for"
            elif broken := self._broken_promises(name):
                impossible[name] = f"broken: {broken}"
            elif is_redundant(self.problem([name]), name):
                impossible[name] = "the model's own equation adds the same already"
            else:
                possible.append(name)
        return tuple(possible), impossible

    def free_forms(self) -> tuple[str, ...]:
        """Names of the free forms that can be tried."""
        usable = registry.usable("effects")
        known = [name for name in usable if isinstance(self.effect(name), FreeForm) and name not in self.own]
        return tuple(name for name in known if not self._inapplicable(name) and self._solvable(name))

    def _inapplicable(self, name: str) -> str:
        """Why an effect cannot be fitted to the records, its columns' units among the reasons; else ""."""
        effect = self.effect(name)
        return unlike_wanted(effect, self.records) or effect.inapplicable(self.records)

    def _solvable(self, name: str) -> bool:
        """Can a law whose many weights are solved for be solved with this effect?"""
        return not isinstance(self.model, Rough) or solvable(self.system([name]))

    def _broken_promises(self, name: str) -> str:
        """Of an effect of another distribution; our own are tested."""
        if name in self.model.offers or registry.load("effects", name).shipped:
            return ""
        return " ".join(broken_promises(System(self.model, ((name, self.effect(name)),)), self.records))


@cache
def _built(name: str) -> Effect:
    """Built once, as finding a plugin takes a while."""
    effect: Effect = registry.build("effects", name)
    return effect

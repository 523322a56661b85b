"""A model with effects around it, as one system with one list of parameters."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal

MOSTLY = 0.75
"""Share of a swarm up to which it is worth the copies to simulate its distinct columns only."""


@dataclass(frozen=True)
class System:
    """A model and the effects around it, innermost first.

    An effect that the model offers acts inside the model, wherever it stands among the others.
    fixed : parameters that are known, by name, in units; a fit does not see them
    Parameters are the model's, then each effect's as "effect.parameter", without the fixed ones;
    values are (dimension, swarm) in that order.
    """

    model: Model
    effects: tuple[tuple[str, Effect], ...] = ()
    fixed: Mapping[str, float] = field(default_factory=dict)

    @property
    def parts(self) -> list[Model | Effect]:
        """The model, and the effects in their order."""
        return [part for _, part in self._stack]

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters with their own default boxes."""
        return self._free([part.parameters for _, part in self._stack])

    @property
    def linear(self) -> tuple[str, ...]:
        """Free parameters in which the output is jointly affine."""
        names = self.model.linear
        for name, effect in self.effects:
            outer = tuple(f"{name}.{parameter}" for parameter in effect.linear)
            names = (*names, *outer) if effect.affine else ()
        return tuple(name for name in names if name not in self.fixed)

    def refusals(self) -> list[str]:
        """Why fixed parameters cannot have their values, a sentence each."""
        every = replace(self, fixed={}).parameters
        return [reason for q in every if q.name in self.fixed and (reason := q.refuses(self.fixed[q.name]))]

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The free parameters with boxes that suit these records."""
        return self._free([part.box(records) for _, part in self._stack])

    def simulate(self, signal: Signal, values: Array) -> Array:
        """values : (dimension, swarm), in units -> (samples, swarm)."""
        return self._wrapped(len(self.effects), signal, self._swarm(values))

    def model_values(self, values: Array) -> Any:
        """The model's own, as it takes them: a namedtuple of (swarm,) arrays."""
        return self._swarm(values).own(0)

    def respond(self, record: Record, values: Array) -> Array:
        """The simulated output of a record, with what its nuisances estimate from it: (samples, swarm)."""
        return next(self.responses([record], values))

    def responses(self, records: Iterable[Record], values: Array) -> Iterator[Array]:
        """As `respond`, of every record."""
        swarm = self._swarm(values)
        for record in records:
            simulated = self._wrapped(len(self.effects), record.signal, swarm)
            yield self._adjusted(record.at_samples(simulated), record, swarm)

    def adjusted(self, simulated: Array, record: Record, values: Array) -> Array:
        """What was simulated at the samples of a record, with what the nuisances estimate from it: (samples, swarm)."""
        return self._adjusted(simulated, record, self._swarm(values))

    def offsets(self, record: Record, values: Array) -> list[Array]:
        """The constant that each effect adds to a record's output, (swarm,) an effect, in their order."""
        simulated = record.at_samples(self.simulate(record.signal, values))
        swarm, found = self._swarm(values), []
        for position, (_, effect) in enumerate(self.effects, start=1):
            found.append(effect.offset(simulated, record, swarm.own(position)))
            simulated = effect.adjust(simulated, record, swarm.own(position))
        return found

    @cached_property
    def _stack(self) -> list[tuple[str, Model | Effect]]:
        return [("", self.model), *((f"{name}.", effect) for name, effect in self.effects)]

    @cached_property
    def _namedtuples(self) -> list[Any]:
        return [_values(*(p.name for p in part.parameters)) for _, part in self._stack]

    @cached_property
    def _model_values(self) -> Any:
        return _values(*(p.name for p in self.model.parameters), *self._inside)

    @cached_property
    def _rows(self) -> list[slice]:
        ends = np.cumsum([0, *(len(part.parameters) for _, part in self._stack)])
        return [slice(int(low), int(high)) for low, high in pairwise(ends)]

    @cached_property
    def _rows_within(self) -> list[Array]:
        """For every depth the rows on which the model in so many effects depends."""
        inside = [self._rows[position] for position in self._inside.values()]
        parts = [[*self._rows[: depth + 1], *inside] for depth in range(len(self._stack))]
        return [np.unique(np.concatenate([np.arange(rows.stop)[rows] for rows in part])) for part in parts]

    @cached_property
    def _names(self) -> list[str]:
        return [prefix + parameter.name for prefix, part in self._stack for parameter in part.parameters]

    @cached_property
    def _free_rows(self) -> list[int]:
        return [row for row, name in enumerate(self._names) if name not in self.fixed]

    @cached_property
    def _fixed_column(self) -> Array:
        return np.array([[self.fixed.get(name, np.nan)] for name in self._names])

    @cached_property
    def _inside(self) -> dict[str, int]:
        """Fields of the model's values that hold an effect's, and where that effect stands."""
        return {
            name.replace("-", "_"): position
            for position, (name, _) in enumerate(self.effects, start=1)
            if name in self.model.offers
        }

    def _adjusted(self, simulated: Array, record: Record, swarm: _Swarm) -> Array:
        for position, (_, effect) in enumerate(self.effects, start=1):
            simulated = effect.adjust(simulated, record, swarm.own(position))
        return simulated

    def _wrapped(self, depth: int, signal: Signal, swarm: _Swarm) -> Array:
        """The model in its innermost `depth` effects."""
        if depth == 0:
            response: Array = self.model.simulate(signal, swarm.own(0))
            return response
        _, effect = self.effects[depth - 1]
        return effect.apply(lambda acting: self._once(depth - 1, acting, swarm), signal, swarm.own(depth))

    def _once(self, depth: int, signal: Signal, swarm: _Swarm) -> Array:
        """The same, columns that differ only further out simulated once: most of the forward differences, and of the
        starts, of an effect on the output."""
        if signal.input.shape[1] > 1:
            return self._wrapped(depth, signal, swarm)
        distinct, place = swarm.distinct(depth)
        found = self._wrapped(depth, signal, distinct)
        return found if distinct is swarm else found.take(place, axis=1)

    def _swarm(self, values: Array) -> _Swarm:
        return _Swarm(self, self._with_fixed(values))

    def _with_fixed(self, values: Array) -> Array:
        if not self.fixed:
            return values
        full = np.repeat(self._fixed_column, values.shape[1], axis=1)
        full[self._free_rows] = values
        return full

    def _free(self, groups: Sequence[Sequence[Parameter]]) -> tuple[Parameter, ...]:
        named = [
            replace(parameter, name=prefix + parameter.name)
            for (prefix, _), group in zip(self._stack, groups, strict=True)
            for parameter in group
        ]
        return tuple(parameter for parameter in named if parameter.name not in self.fixed)


class _Swarm:
    """Values of a swarm, the fixed ones too, cut for the parts of a system: once for all records.

    full : (dimension, swarm)
    """

    def __init__(self, system: System, full: Array) -> None:
        self._system, self._full = system, full
        self._own: dict[int, Any] = {}
        self._distinct: dict[int, tuple[_Swarm, Array]] = {}

    def own(self, position: int) -> Any:
        """Of the model, at 0, or of an effect, innermost first: a namedtuple of (swarm,) arrays."""
        if position not in self._own:
            self._own[position] = self._cut(position)
        return self._own[position]

    def _cut(self, position: int) -> Any:
        system = self._system
        named = system._namedtuples[position](*self._full[system._rows[position]])
        if position or not system._inside:
            return named
        return system._model_values(*named, *map(self.own, system._inside.values()))

    def distinct(self, depth: int) -> tuple[_Swarm, Array]:
        """Columns in which the model in so many effects differs, and which of them every column is; itself, where
        that would spare little."""
        if depth not in self._distinct:
            self._distinct[depth] = self._found(depth)
        return self._distinct[depth]

    def _found(self, depth: int) -> tuple[_Swarm, Array]:
        from hysteresis_bench.kernels.distinct_columns import distinct_columns

        swarm = self._full.shape[1]
        first, place = distinct_columns(self._full, self._system._rows_within[depth])
        if swarm == 1 or first.size > MOSTLY * swarm:
            return self, place
        return _Swarm(self._system, np.ascontiguousarray(self._full[:, first])), place


@lru_cache
def _values(*names: str) -> Any:
    """Made once: a class takes longer than a short simulation."""
    return namedtuple("Values", names)

"""A model with effects around it, as one system with one list of parameters."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from numpy.typing import NDArray

from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal


@dataclass(frozen=True)
class System:
    """A model and the effects around it, innermost first.

    Parameters are the model's, then each effect's as "effect.parameter"; values are (dimension, swarm)
    in that order.
    """

    model: Model
    effects: tuple[tuple[str, Effect], ...] = ()

    @cached_property
    def _parts(self) -> list[tuple[str, Model | Effect, Any, slice]]:
        parts = []
        position = 0
        stack: list[tuple[str, Model | Effect]] = [("", self.model)]
        stack += [(f"{name}.", effect) for name, effect in self.effects]
        for prefix, part in stack:
            names = [parameter.name for parameter in part.parameters]
            parts.append((prefix, part, namedtuple("Values", names), slice(position, position + len(names))))
            position += len(names)
        return parts

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """All parameters with their own default boxes."""
        return self._named([part.parameters for _, part, _, _ in self._parts])

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """All parameters with boxes that suit these records."""
        return self._named([part.box(records) for _, part, _, _ in self._parts])

    def _named(self, groups: Sequence[Sequence[Parameter]]) -> tuple[Parameter, ...]:
        return tuple(
            replace(parameter, name=prefix + parameter.name)
            for (prefix, _, _, _), group in zip(self._parts, groups, strict=True)
            for parameter in group
        )

    def simulate(self, signal: Signal, values: NDArray) -> NDArray:
        """values : (dimension, swarm), in units -> (samples, swarm)."""
        _, model, named, columns = self._parts[0]
        p = named(*values[columns])

        def run(inner_signal: Signal) -> NDArray:
            return model.simulate(inner_signal, p)  # type: ignore[union-attr]

        for _, effect, effect_named, effect_columns in self._parts[1:]:
            run = self._wrapped(effect, run, effect_named(*values[effect_columns]))  # type: ignore[arg-type]
        return run(signal)

    @staticmethod
    def _wrapped(effect: Effect, inner: Any, p: Any) -> Any:
        return lambda signal: effect.apply(inner, signal, p)

    def respond(self, record: Record, values: NDArray) -> NDArray:
        """The simulated output of a record, with what its nuisances estimate from it: (samples, swarm)."""
        simulated = self.simulate(record.signal, values)
        for _, effect in self.effects:
            simulated = effect.adjust(simulated, record)
        return simulated

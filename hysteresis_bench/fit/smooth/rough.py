"""Which laws have so many linear parameters that they want to be smooth, and can be solved for."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System


@runtime_checkable
class Rough(Protocol):
    """A model whose linear parameters are so many that they want to be smooth."""

    @property
    def linear(self) -> tuple[str, ...]: ...

    def roughness(self, p: Any) -> Array:
        """(rows, len(linear)): what a smooth law has little of; p as in `Model.simulate`, a swarm of 1, of which only
        the parameters that are not linear matter."""


def solvable(system: System) -> bool:
    """Is it a rough law whose linear parameters are still linear behind the effects around it?"""
    return isinstance(system.model, Rough) and {*system.model.linear} <= {*system.linear}

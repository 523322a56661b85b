"""What a fitted law remembers: its Everett function, from first-order reversal curves, and its density.

The law alone is asked, without the effects around it, over the range of the input that was fitted.

[1] I. D. Mayergoyz, Mathematical Models of Hysteresis, Springer (1991), section 1.3.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.signals import Signal

LEVELS = 41
"""Of the input, between which curves turn."""
FINE = 12
"""Samples from one level to the next."""
WIDE = 3
"""Levels over which a density is averaged: that of a law of few plays would be needles."""
PASSES = 3
"""Through the whole range, before the curves that count: what the law knew at rest is forgotten."""


@dataclass(frozen=True, eq=False)
class Everett:
    """levels : (levels,) of the input as it is measured, rising
    values : (upper, lower) half of what the output falls from the upper level, reached from below the range, to the
    lower one; NaN where lower is above upper; unit of the output
    """

    levels: Array
    values: Array

    @property
    def density(self) -> tuple[Array, Array]:
        """Middles (squares,) and minus the mixed derivative there [1], (upper, lower), output over the input squared.

        NaN where a square of WIDE levels reaches across the diagonal, on which lies what has no memory.
        """
        e, step = self.values, self.levels[WIDE] - self.levels[0]
        mixed = -(e[WIDE:, WIDE:] - e[WIDE:, :-WIDE] - e[:-WIDE, WIDE:] + e[:-WIDE, :-WIDE]) / step**2
        return 0.5 * (self.levels[WIDE:] + self.levels[:-WIDE]), mixed


@runtime_checkable
class Plays(Protocol):
    """A model that is a sum of plays, or of elements that slip, beside a part without memory."""

    def density(self, p: Any, places: Array) -> tuple[Array, Array, str]:
        """Thresholds (rows,), rising, weights, and what a weight is, in words; p as in `Model.simulate`, a swarm of 1.

        weights : (rows, places) where a play has them when it stands at these places of the input, rising, or (rows, 1)
        where they are the same everywhere; unit of the output over that of the input
        """


@dataclass(frozen=True, eq=False)
class Density:
    """thresholds : (rows,) half-widths, rising, unit of the input;  meaning : of a weight, in words
    weights : (rows, places), or (rows, 1) where they are the same everywhere; unit of the output over the input's
    """

    thresholds: Array
    weights: Array
    meaning: str


def fitted_range(fitted: FittedModel) -> tuple[float, float] | None:
    """Of the input, as it is measured; None where the model does not say, or the input never moved."""
    low, high = fitted.data.get("ranges", {}).get("input", (0.0, 0.0))
    return (low, high) if low < high else None


def everett(fitted: FittedModel, ends: tuple[float, float]) -> Everett | None:
    """E(upper, lower) = (f_upper - f_upper,lower) / 2 [1], unit of the output; None where the law is not
    rate-independent, or does not answer."""
    law, values = _law(fitted)
    if "rate-independent" not in law.model.properties:
        return None
    levels = np.linspace(*ends, LEVELS)
    low, high, steps = ends[0], ends[1], FINE * (LEVELS - 1)
    rising = np.linspace(low, high, steps + 1)
    cycle = np.concatenate([rising, rising[-2:0:-1]])
    way = np.concatenate([np.linspace(0.5 * (low + high), low, steps // 2, endpoint=False), *[cycle] * PASSES])
    last = np.concatenate([rising, rising[-2::-1]])
    # a law that does not know time may wait at its reversal: all curves are as long
    u = np.concatenate([np.repeat(way[:, None], LEVELS, axis=1), np.minimum(last[:, None], levels)])
    seen = fitted.preparation.seen_input(u)
    signal = Signal(np.arange(float(len(u))), np.ascontiguousarray(seen), timed=False)
    y = law.simulate(signal, np.repeat(values, LEVELS, axis=1))
    begun, fallen = len(way) + steps, y[::-FINE][:LEVELS]  # of every level, the lowest first
    found = 0.5 * (y[begun] - fallen).T
    found[np.triu_indices(LEVELS, 1)] = np.nan
    return Everett(levels, found) if np.all(np.isfinite(y)) else None


def density(fitted: FittedModel, places: Array) -> Density | None:
    """Of a law that is a sum of plays; places : (places,) of the input as it is measured, rising."""
    law, values = _law(fitted)
    seen = fitted.preparation.seen_input(places)
    if not isinstance(law.model, Plays):
        return None
    thresholds, weights, meaning = law.model.density(law.model_values(values), np.sort(seen))
    return Density(thresholds, -weights[:, ::-1] if fitted.preparation.flip else weights, meaning)


def _law(fitted: FittedModel) -> tuple[System, Array]:
    """Without effects, all its parameters free, and their values (dimension, 1)."""
    system = System(registry.build("models", fitted.model, fitted.settings))
    known = {**{name: one.value for name, one in fitted.parameters.items()}, **fitted.fixed}
    return system, np.array([[known[parameter.name]] for parameter in system.parameters])


def ways(reversals: Sequence[float]) -> Iterator[tuple[float, float, float]]:
    """Where an input went that turned at these values, in the half plane of upper and lower reversals.

    (turned, begin, end) each: where it had turned, as long as that was not wiped out, and its way since.
    """
    memory = list(reversals[:1])
    for end in reversals[1:]:
        at = memory[-1]
        while len(memory) > 1 and (end - at) * (end - memory[-2]) > 0.0:
            yield memory[-1], at, memory[-2]
            at = memory[-2]
            memory = memory[:-2] or memory[-1:]
        yield memory[-1], at, end
        memory.append(end)

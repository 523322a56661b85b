"""Fits hypotheses around a law of many linear parameters: they are solved for, as smooth as predicts best.

Such a law, a density read off the data, is not searched: whatever it is come upon from, a set of effects around it has
one answer. What counts as its parameters is the effective number of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis, at_bound
from hysteresis_bench.diagnosis.hypotheses.nested_test import NestedTest, nested_test
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.fit.smooth.rough import Rough
from hysteresis_bench.fit.smooth.smoothing import Smoothed, Smoothing
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.whole import left_out
from hysteresis_bench.signals import Record


@dataclass(frozen=True, eq=False)
class Smooth(Hypothesis):
    """weight : of the roughness, as a power of ten;  freedom : effective number of parameters"""

    weight: float
    freedom: float


@dataclass(frozen=True, eq=False)
class SmoothFitter(Fitter):
    """like : what is asked is like what is left out of the fits (fit/unseen/likeness.py)"""

    like: bool = False

    def from_anywhere(self, names: frozenset[str]) -> Hypothesis:
        """Solved; there is no other way to it."""
        if names not in self._known:
            self._known[names] = self._solved(names)
        return self._known[names]

    def step_by_step(self, names: frozenset[str]) -> list[Hypothesis]:
        return []

    def extended(
        self, hypothesis: Hypothesis, name: str, other: Mapping[str, float] | None = None, near: float = np.inf
    ) -> Hypothesis:
        return self.from_anywhere(hypothesis.names | {name})

    def reduced(self, hypothesis: Hypothesis, name: str) -> Hypothesis:
        return self.from_anywhere(hypothesis.names - {name})

    def refitted(self, hypothesis: Hypothesis) -> Hypothesis:
        return hypothesis

    def followed(self, hypothesis: Hypothesis) -> Hypothesis:
        return self.from_anywhere(hypothesis.names)

    def polished(self, hypothesis: Hypothesis) -> Array:
        return Smoothing(self.stack.problem(hypothesis.names)).refitted(self._smoothed(hypothesis))

    def unseen(self, hypothesis: Hypothesis) -> Array:
        """Errors (scored samples,) of what was left out of its fit, as it was solved."""
        return hypothesis.left_out

    def errors_without(self, hypothesis: Hypothesis, records: tuple[Record, ...], blocks: Blocks) -> Array:
        problem = replace(self.stack.problem(hypothesis.names), records=records)
        return Smoothing(problem).without(self._smoothed(hypothesis), blocks)

    def fitted_values(self, hypothesis: Hypothesis) -> int:
        assert isinstance(hypothesis, Smooth)
        return round(hypothesis.freedom)

    def _tested(self, smaller: Hypothesis, larger: Hypothesis, searched: int) -> NestedTest:
        """Of the errors left out, with the effect's own parameters: beside it the density may be less smooth, and what
        that alone takes off the errors of the fit is not the effect's."""
        added = max(super().fitted_values(larger) - super().fitted_values(smaller), 1) + searched
        less, more = (split(hypothesis.left_out, self.stack.records) for hypothesis in (smaller, larger))
        return nested_test(less, more, added, added)

    def _smoothed(self, hypothesis: Hypothesis) -> Smoothed:
        assert isinstance(hypothesis, Smooth)
        space = self.stack.problem(hypothesis.names).space
        # of an offset that joined later only the weight is asked, which is solved for
        values = np.array([hypothesis.values.get(p.name, 0.5 * (p.lower + p.upper)) for p in space.parameters])
        return Smoothed(values, hypothesis.left_out, hypothesis.weight, hypothesis.freedom)

    @cached_property
    def _known(self) -> dict[frozenset[str], Hypothesis]:
        return {}

    def _solved(self, names: frozenset[str]) -> Smooth:
        problem = self.stack.problem(names)
        found = Smoothing(problem).searched(replace(left_out(self.stack.records), like=self.like))
        point = problem.space.to_unit(found.values[:, None])[:, 0]
        own = {*problem.system.model.linear}
        return Smooth(
            names,
            dict(zip(problem.space.names, found.values.tolist(), strict=True)),
            self.errors(names, found.values),
            found.left_out,
            tuple(
                p.name
                for p, x in zip(problem.space.parameters, point, strict=True)
                if p.name not in own and at_bound(p, x) and p.name not in self._limits(names)
            ),
            found.weight,
            found.freedom,
        )


def fitter_of(stack: Stack, seed: int, *, like: bool = False) -> Fitter:
    """As the stack's model asks for.  like : as of `SmoothFitter`"""
    return SmoothFitter(stack, seed, like) if isinstance(stack.model, Rough) else Fitter(stack, seed)

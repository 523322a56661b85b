"""Fits hypotheses: global searches, warm starts, and the errors on samples left out."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.random import default_rng

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.evidence.noise import input_noise
from hysteresis_bench.diagnosis.hypotheses.chains import LAST, optimum
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Behind, Hypothesis, at_bound
from hysteresis_bench.diagnosis.hypotheses.nested_test import SEARCHED, NestedTest, nested_test
from hysteresis_bench.diagnosis.hypotheses.starts import grid
from hysteresis_bench.diagnosis.hypotheses.systems import Stack, is_curve
from hysteresis_bench.fit.least_squares import descend, errors, jacobian, point_of, split, values_of
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, shared_start
from hysteresis_bench.fit.unseen.advantage import chance
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.excitations import Excitations, excitations
from hysteresis_bench.fit.unseen.left_out import cut, errors_without, left_out_errors
from hysteresis_bench.fit.unseen.whole import extrapolated, left_out
from hysteresis_bench.free_forms import FreeForm
from hysteresis_bench.signals import Record

BUDGET = 1500
"""Evaluations of a global search: for the bare model, and when an effect has joined."""

SEARCHES = 2
"""Global searches of a system from seeds of their own; the better one counts."""

RANDOM = 192
"""Points screened for another basin of attraction after an effect has joined."""

CHAINS = 4
"""Of them followed downhill."""

DROWNED = 4.0
"""Of the RMS noise of a measured input, what a width on its axis must have: noise rarely swings wider. Bands that noise
alone made were 0.9 and 1.9 times as wide; with twice this, real ones of up to 8 times are missed."""


@dataclass(frozen=True, eq=False)
class Fitter:
    """Fits hypotheses to the fitted records; the same question always gets the same answer."""

    stack: Stack
    seed: int = 0

    @cached_property
    def blocks(self) -> Blocks:
        return cut(self.stack.records)

    @cached_property
    def excitations(self) -> Excitations:
        return excitations(self.stack.records)

    def fitted(self, hypothesis: Hypothesis) -> tuple[System, Array]:
        """The system of a hypothesis, and its values (dimension,) in units."""
        problem = self.stack.problem(hypothesis.names)
        return problem.system, np.array([hypothesis.values[name] for name in problem.space.names])

    def bare(self, names: frozenset[str]) -> Hypothesis:
        """As nothing is known yet: from anywhere, and with effects of the user's also from the model without them."""
        return min([self.from_anywhere(names), *self.step_by_step(names)], key=lambda one: one.rmse)

    def from_anywhere(self, names: frozenset[str]) -> Hypothesis:
        """A global search."""
        problem = self.stack.problem(names)
        starts = [self._searched(problem, run) for run in range(SEARCHES)]
        centre = np.full((problem.space.dimension, 1), 0.5)
        points = np.column_stack([*starts, self._random(problem, centre)])
        return self._finished(problem, names, points)

    def step_by_step(self, names: frozenset[str]) -> list[Hypothesis]:
        """From the model alone, with the user's effects joined one after the other, the one that helps most first; none
        where there are none. Among many parameters a search from anywhere may miss what the model alone leads to."""
        own = {*self.stack.own} - names
        if not own:
            return []
        alone = replace(self, stack=replace(self.stack, own=()))
        current = alone.bare(names)
        while left := sorted(own - current.names):
            best = min((alone.extended(current, name) for name in left), key=lambda one: one.rmse)
            current = alone.refitted(best)
        return [self.followed(replace(current, names=names))]

    def extended(
        self, hypothesis: Hypothesis, name: str, other: Mapping[str, float] | None = None, near: float = np.inf
    ) -> Hypothesis:
        """With one effect more, from several values of its own parameters.

        other : further values of the known parameters to begin from, as of a system with another effect in its place
        near : the RMSE to come up to, as that system's; what stays far behind is `Behind`
        """
        names = hypothesis.names | {name}
        problem = self.stack.problem(names)
        new = [p for p in problem.space.parameters if p.name not in hypothesis.values]
        proposed = self._proposed(hypothesis, name)
        if proposed is None:
            off = {p.name: 0.5 * (p.lower + p.upper) if p.null is None else p.null for p in new}
            return replace(hypothesis, names=names, values={**hypothesis.values, **off})
        linear = isinstance(self.stack.effect(name), FreeForm)  # or nearly so: one start will do
        spread = [*grid(new)[: 1 if linear else None], *proposed]
        points = np.column_stack([point_of(problem, {**hypothesis.values, **values}) for values in spread])
        if new:
            points = points[:, self._promising(hypothesis, problem, points, hypothesis.values)]
        if other is not None:
            exchanged = np.column_stack(
                [point_of(problem, {**hypothesis.values, **other, **values}) for values in spread]
            )
            best = np.argsort(problem.squares(exchanged), kind="stable")[:CHAINS]
            points = np.column_stack([points, exchanged[:, best]])
        found = self._finished(problem, names, points, near)
        # a curve may take over what the shape of the law alone was bent to; one that is linear is solved for at once
        effect = self.stack.effect(name)
        curve = linear and is_curve(effect) and not effect.linear and not isinstance(found, Behind)
        return min(found, self.from_anywhere(names), key=lambda one: one.rmse) if curve else found

    def reduced(self, hypothesis: Hypothesis, name: str) -> Hypothesis:
        """With one effect less."""
        names = hypothesis.names - {name}
        problem = self.stack.problem(names)
        known = {
            **hypothesis.values,
            **{p.name: 0.5 * (p.lower + p.upper) for p in problem.space.parameters if p.name not in hypothesis.values},
        }
        point = point_of(problem, known)[:, None]
        return self._finished(problem, names, np.column_stack([point, self._random(problem, point)[:, :2]]))

    def refitted(self, hypothesis: Hypothesis) -> Hypothesis:
        """From other starts as well: what an effect explains may have been bent into the values of others."""
        problem = self.stack.problem(hypothesis.names)
        point = point_of(problem, hypothesis.values)[:, None]
        own = [p.name for p in self.stack.model.parameters if p.name in hypothesis.values]
        effects = np.array([name not in own for name in problem.space.names])
        starts = [point, self._random(problem, point), self._searched(problem, 0)[:, None]]
        if effects.any():
            elsewhere = np.repeat(point, RANDOM, axis=1)
            elsewhere[effects, 1:] = default_rng(self.seed).random((int(effects.sum()), RANDOM - 1))
            starts.append(elsewhere[:, self._promising(hypothesis, problem, elsewhere, own)[1:]])
        found = self._finished(problem, hypothesis.names, np.column_stack(starts))
        return found if found.rmse < hypothesis.rmse else hypothesis

    def followed(self, hypothesis: Hypothesis) -> Hypothesis:
        """Downhill from where it was found, as on records that were prepared otherwise."""
        problem = self.stack.problem(hypothesis.names)
        return self._finished(problem, hypothesis.names, point_of(problem, hypothesis.values)[:, None])

    def polished(self, hypothesis: Hypothesis) -> Array:
        """Values (dimension,) in units, from those of a hypothesis that was fitted to thinned records."""
        problem = self.stack.problem(hypothesis.names)
        point, _ = descend(problem, point_of(problem, hypothesis.values)[:, None], iterations=LAST)
        return problem.space.from_unit(point)[:, 0]

    def unseen(self, hypothesis: Hypothesis) -> Array:
        """Errors (scored samples,) of every record by a fit to the others; of a lone record, and of one that goes
        further than all others, those of its blocks."""
        if len(self.stack.records) == 1:
            return hypothesis.left_out
        return self._without(hypothesis, left_out(self.stack.records, self.extrapolated(hypothesis)).blocks)

    def extrapolated(self, hypothesis: Hypothesis) -> frozenset[int]:
        """Numbers of the records on which a curve of it would be extrapolated, if it were fitted to all others."""
        return extrapolated(map(self.stack.effect, sorted(hypothesis.names)), self.stack.records)

    def apart(self, hypothesis: Hypothesis) -> Array:
        """Errors (scored samples,) of every record, of a lone one of every part, by a fit to the others."""
        number = self.excitations.number
        return self._without(hypothesis, Blocks(number, number, int(number.max()) + 1))

    def _without(self, hypothesis: Hypothesis, blocks: Blocks) -> Array:
        left = self.errors_without(hypothesis, self.stack.records, blocks)
        return left[np.arange(blocks.fold.size), blocks.fold]

    def errors_without(self, hypothesis: Hypothesis, records: tuple[Record, ...], blocks: Blocks) -> Array:
        """Errors (scored samples, folds) of all samples by the fits without each fold.

        records : those of the stack, in the order of the blocks"""
        problem = replace(self.stack.problem(hypothesis.names), records=records)
        return errors_without(problem, point_of(problem, hypothesis.values), blocks)

    def errors(self, names: Collection[str], values: Array) -> Array:
        """Measured minus simulated (scored samples,); values : (dimension,), in units."""
        problem = self.stack.problem(names)
        return errors(problem, problem.space.to_unit(values[:, None]))[:, 0]

    def test(self, smaller: Hypothesis, larger: Hypothesis) -> NestedTest:
        """Is the larger one better than chance, as fitted or on blocks left out? Not where what it has more is no wider
        than the input's noise."""
        if any(self.drowned(larger, name) for name in larger.names - smaller.names):
            return NestedTest(0.0, 1.0, 0)
        nuisance = {*registry.OFFSETS} >= larger.names ^ smaller.names
        fitted = self._tested(smaller, larger, 0 if nuisance else SEARCHED)
        return fitted.either(chance(larger.left_out, smaller.left_out, self.blocks))

    def _tested(self, smaller: Hypothesis, larger: Hypothesis, searched: int) -> NestedTest:
        known, all_ = (self.fitted_values(hypothesis) for hypothesis in (smaller, larger))
        less, more = (split(hypothesis.residuals, self.stack.records) for hypothesis in (smaller, larger))
        return nested_test(less, more, max(all_ - known, 1) + searched, all_)

    def fitted_values(self, hypothesis: Hypothesis) -> int:
        """Parameters, and what effects estimate on every record."""
        own = sum(self.stack.effect(name).estimates for name in hypothesis.names)
        return len(self.stack.problem(hypothesis.names).space.names) + own * len(self.stack.records)

    @cached_property
    def _input_noise(self) -> float:
        """RMS over the records, unit of the input."""
        return float(np.sqrt(np.mean([input_noise(record.time, record.input) ** 2 for record in self.stack.records])))

    def drowned(self, hypothesis: Hypothesis, name: str) -> bool:
        """Is an effect's width on the input's axis, such as a dead band's, within the noise of the measured input?
        Such a band takes small false reversals out, whatever the device does. Of several widths the largest counts."""
        widths = [
            abs(hypothesis.values[f"{name}.{p.name}"] - p.null)
            for p in self.stack.effect(name).parameters
            if p.unit == "{input}" and p.null is not None and f"{name}.{p.name}" in hypothesis.values
        ]
        return 0.0 < max(widths, default=0.0) < DROWNED * self._input_noise

    def _proposed(self, hypothesis: Hypothesis, name: str) -> list[dict[str, float]] | None:
        """What the effect itself proposes, from the residuals; None where they show nothing of it."""
        records = self.stack.records
        proposals = self.stack.effect(name).starts(records, split(hypothesis.residuals, records))
        return proposals and [{f"{name}.{key}": value for key, value in one.items()} for one in proposals]

    def _promising(self, hypothesis: Hypothesis, problem: Problem, points: Array, following: Collection[str]) -> Array:
        """Columns that leave least once the `following` parameters have followed to first order, unlike each
        other; the first column always."""
        known = self.stack.problem(hypothesis.names)
        left = errors(problem, points)
        rows = [row for row, name in enumerate(known.space.names) if name in following]
        if rows:
            slopes = jacobian(known, point_of(known, hypothesis.values)[:, None])[1][:, 0, rows]
            basis = np.linalg.svd(slopes, full_matrices=False)[0]
            left = left - basis @ (basis.T @ left)
        order = np.argsort(np.einsum("ij,ij->j", left, left), kind="stable")
        chosen: list[int] = [0]
        for column in order:
            if len(chosen) == CHAINS + 1:
                break
            apart = np.max(np.abs(points[:, chosen] - points[:, [column]]), axis=0)
            if np.all(apart > 0.05):
                chosen.append(int(column))
        return np.array(chosen)

    def _searched(self, problem: Problem, run: int) -> Array:
        """The best point (dimension,) of a global search."""
        if not problem.space.dimension:
            return np.empty(0)
        start = shared_start(problem.space.dimension, self.seed, "diagnosis", run)
        optimizer = registry.build("optimizers", registry.SEARCH)
        rng = generator(self.seed, "diagnosis", run)
        found = search(problem, optimizer, budget=BUDGET, start=start, rng=rng)
        return problem.space.to_unit(found.values[:, None])[:, 0]

    def _random(self, problem: Problem, around: Array) -> Array:
        """The best of random points: anywhere, and with some of the parameters as they are."""
        dimension = problem.space.dimension
        rng = default_rng(self.seed)
        points = rng.random((dimension, RANDOM))
        points[:, RANDOM // 2 :] = np.where(
            rng.random((dimension, RANDOM // 2)) < 0.5, points[:, RANDOM // 2 :], around
        )
        return points[:, np.argsort(problem.squares(points), kind="stable")[:CHAINS]]

    def _finished(self, problem: Problem, names: frozenset[str], starts: Array, near: float = np.inf) -> Hypothesis:
        points, behind = optimum(problem, starts, near)
        point, left = points[:, 0], errors(problem, points)[:, 0]
        values = values_of(problem, point)
        if behind:
            return Behind(names, values, left, left, ())
        own = problem.system.model.linear
        return Hypothesis(
            names,
            values,
            left,
            left_out_errors(problem, point, self.blocks),
            tuple(
                p.name
                for p, x in zip(problem.space.parameters, point, strict=True)
                if at_bound(replace(p, null=0.0) if p.name in own else p, x) and p.name not in self._limits(names)
            ),
        )

    def _limits(self, names: Collection[str]) -> set[str]:
        """Parameters of free forms that may lie at an edge of their box."""
        forms = {name: effect for name in names if isinstance(effect := self.stack.effect(name), FreeForm)}
        return {f"{name}.{parameter}" for name, form in forms.items() for parameter in form.limits}

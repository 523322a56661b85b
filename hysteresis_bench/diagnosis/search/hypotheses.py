"""One hypothesis, fitted: a set of effects around the model, with its errors fitted and left out."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.random import default_rng

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.search.cross_validation import Blocks, cut, left_out_errors
from hysteresis_bench.diagnosis.search.nested_test import SEARCHED, NestedTest, nested_test
from hysteresis_bench.diagnosis.search.systems import Stack
from hysteresis_bench.fit.least_squares import descend, errors, jacobian, point_of, split, values_of
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, shared_start
from hysteresis_bench.parameters import Parameter

BUDGET = 1500
"""Evaluations of a global search: for the bare model, and when an effect has joined."""

SEARCHES = 2
GRID = 48
"""Values of an effect's own parameters that are screened, in one swarm."""

CHAINS = 4
"""Of them followed downhill."""

FIRST, LAST = 8, 40
"""Iterations of all chains, then of the best one."""

RANDOM = 192
"""Points screened for another basin of attraction after an effect has joined."""

EDGE = 1e-3
"""A parameter within this share of its box from an edge lies at its bound."""


@dataclass(frozen=True, eq=False)
class Trial:
    """names : the effects;  values : by parameter's name, in units
    residuals, left_out : (scored samples,), measured minus simulated: of the fit, and of samples left out of it
    at_bound : parameters at an edge of their box that does not mean "off"
    """

    names: frozenset[str]
    values: Mapping[str, float]
    residuals: Array
    left_out: Array
    at_bound: tuple[str, ...]

    @property
    def rmse(self) -> float:
        return float(np.sqrt(np.mean(self.residuals**2)))

    @property
    def cv_rmse(self) -> float:
        return float(np.sqrt(np.mean(self.left_out**2)))

    def apart(self, other: Trial) -> float:
        """RMS difference of the two fitted outputs, unit of the output."""
        return float(np.sqrt(np.mean((self.residuals - other.residuals) ** 2)))


@dataclass(frozen=True, eq=False)
class Bench:
    """Fits hypotheses to the fitted records; the same question always gets the same answer."""

    stack: Stack
    seed: int = 0

    @cached_property
    def blocks(self) -> Blocks:
        return cut(self.stack.records)

    def fitted(self, trial: Trial) -> tuple[System, Array]:
        """The system of a trial, and its values (dimension,) in units."""
        problem = self.stack.problem(trial.names)
        return problem.system, np.array([trial.values[name] for name in problem.space.names])

    def bare(self, names: frozenset[str]) -> Trial:
        """A global search, as nothing is known yet."""
        problem = self.stack.problem(names)
        starts = [self._searched(problem, run) for run in range(SEARCHES)]
        centre = np.full((problem.space.dimension, 1), 0.5)
        points = np.column_stack([*starts, self._random(problem, centre)])
        return self._finished(problem, names, points)

    def extended(self, trial: Trial, name: str, other: Mapping[str, float] | None = None) -> Trial:
        """With one effect more, from several values of its own parameters.

        other : further values of the known parameters from which to begin, such as those of a system in which
        another effect stands in this one's place
        """
        names = trial.names | {name}
        problem = self.stack.problem(names)
        new = [p for p in problem.space.parameters if p.name not in trial.values]
        grid = [*_grid(new), *self._proposed(trial, name)]
        points = np.column_stack([point_of(problem, {**trial.values, **values}) for values in grid])
        if new:
            points = points[:, self._promising(trial, problem, points, trial.values)]
        if other is not None:
            exchanged = np.column_stack([point_of(problem, {**trial.values, **other, **values}) for values in grid])
            best = np.argsort(problem.squares(exchanged), kind="stable")[:CHAINS]
            points = np.column_stack([points, exchanged[:, best]])
        return self._finished(problem, names, points)

    def reduced(self, trial: Trial, name: str) -> Trial:
        """With one effect less."""
        names = trial.names - {name}
        problem = self.stack.problem(names)
        known = {
            **trial.values,
            **{p.name: 0.5 * (p.lower + p.upper) for p in problem.space.parameters if p.name not in trial.values},
        }
        point = point_of(problem, known)[:, None]
        return self._finished(problem, names, np.column_stack([point, self._random(problem, point)[:, :2]]))

    def refitted(self, trial: Trial) -> Trial:
        """From other starts as well: what an effect explains may have been bent into the values of others."""
        problem = self.stack.problem(trial.names)
        point = point_of(problem, trial.values)[:, None]
        own = [p.name for p in self.stack.model.parameters if p.name in trial.values]
        effects = np.array([name not in own for name in problem.space.names])
        starts = [point, self._random(problem, point), self._searched(problem, 0)[:, None]]
        if effects.any():
            elsewhere = np.repeat(point, RANDOM, axis=1)
            elsewhere[effects, 1:] = default_rng(self.seed).random((int(effects.sum()), RANDOM - 1))
            starts.append(elsewhere[:, self._promising(trial, problem, elsewhere, own)[1:]])
        found = self._finished(problem, trial.names, np.column_stack(starts))
        return found if found.rmse < trial.rmse else trial

    def polished(self, trial: Trial) -> Array:
        """Values (dimension,) in units, from those of a trial that was fitted to thinned records."""
        problem = self.stack.problem(trial.names)
        point, _ = descend(problem, point_of(problem, trial.values)[:, None], iterations=LAST)
        return problem.space.from_unit(point)[:, 0]

    def errors(self, names: Collection[str], values: Array) -> Array:
        """Measured minus simulated (scored samples,); values : (dimension,), in units."""
        problem = self.stack.problem(names)
        return errors(problem, problem.space.to_unit(values[:, None]))[:, 0]

    def test(self, smaller: Trial, larger: Trial) -> NestedTest:
        """Is the larger one better than chance?"""
        known, all_ = (len(self.stack.problem(trial.names).space.names) for trial in (smaller, larger))
        offsets = len(self.stack.records)
        count = [offsets if registry.RECORD_OFFSET in trial.names else 0 for trial in (smaller, larger)]
        nuisance = {*registry.OFFSETS} >= larger.names ^ smaller.names
        added = all_ - known + count[1] - count[0]
        less, more = (split(trial.residuals, self.stack.records) for trial in (smaller, larger))
        return nested_test(less, more, max(added, 1) + (0 if nuisance else SEARCHED), all_ + count[1])

    def _proposed(self, trial: Trial, name: str) -> list[dict[str, float]]:
        """What the effect itself proposes, from the residuals."""
        residuals = split(trial.residuals, self.stack.records)
        proposals = self.stack.effect(name).starts(self.stack.records, residuals)
        return [{f"{name}.{key}": value for key, value in proposal.items()} for proposal in proposals]

    def _promising(self, trial: Trial, problem: Problem, points: Array, following: Collection[str]) -> Array:
        """Columns that leave least once the `following` parameters have followed to first order, unlike each
        other; the first column always."""
        known = self.stack.problem(trial.names)
        left = errors(problem, points)
        rows = [row for row, name in enumerate(known.space.names) if name in following]
        if rows:
            slopes = jacobian(known, point_of(known, trial.values)[:, None])[1][:, 0, rows]
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
        found = search(problem, optimizer, BUDGET, start, generator(self.seed, "diagnosis", run))
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

    def _finished(self, problem: Problem, names: frozenset[str], starts: Array) -> Trial:
        points, squares = descend(problem, starts, iterations=FIRST)
        best = points[:, np.argsort(squares, kind="stable")[:2]]
        points, squares = descend(problem, best, iterations=FIRST)
        points, squares = descend(problem, points[:, [int(np.argmin(squares))]], iterations=LAST)
        point = points[:, 0]
        return Trial(
            names,
            values_of(problem, point),
            errors(problem, points)[:, 0],
            left_out_errors(problem, point, self.blocks),
            tuple(p.name for p, x in zip(problem.space.parameters, point, strict=True) if _at_bound(p, x)),
        )


def _at_bound(parameter: Parameter, x: float) -> bool:
    if EDGE < x < 1.0 - EDGE:
        return False
    edge = parameter.lower if x <= EDGE else parameter.upper
    off = parameter.null is not None and (edge == parameter.null or (parameter.scaling == "log" and x <= EDGE))
    return not off


def _grid(parameters: list[Parameter]) -> list[dict[str, float]]:
    """Switched off; then values spread over the box, those of a linear switch denser towards its null."""
    from scipy.stats.qmc import Halton

    off = {p.name: _inside(p) if p.null is None else float(np.clip(p.null, p.lower, p.upper)) for p in parameters}
    if not parameters:
        return [{}]
    spread = Halton(len(parameters), scramble=False).random(GRID + 1)[1:]
    return [off, *({p.name: _at(p, x) for p, x in zip(parameters, row, strict=True)} for row in spread)]


def _inside(p: Parameter) -> float:
    return float(np.sqrt(p.lower * p.upper)) if p.scaling == "log" else 0.5 * (p.lower + p.upper)


def _at(p: Parameter, x: float) -> float:
    if p.scaling == "log":
        return float(p.lower * (p.upper / p.lower) ** x)
    if p.null is None:
        return p.lower + x * (p.upper - p.lower)
    below = max(p.null - p.lower, 0.0) / (p.upper - p.lower)
    edge, share = (p.lower, (below - x) / below) if x < below else (p.upper, (x - below) / (1.0 - below))
    return float(p.null + (edge - p.null) * 10.0 ** (3.0 * (share - 1.0)))

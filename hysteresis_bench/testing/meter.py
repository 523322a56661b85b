"""A search on a meter that is watched: an independent count, and every point that was asked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model, Optimizer
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import BudgetSpent, Objective, Problem, Trace
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record
from hysteresis_bench.testing.contract import expect
from hysteresis_bench.testing.examples import Waves, lock

TRUTH = np.array([0.31, 0.72, 0.55, 0.13, 0.88])
TIME = lock(np.linspace(0.0, 1.0, 16))

T = TypeVar("T")


@dataclass
class Watched:
    """The real meter behind a second count. An optimizer sees what contracts.Objective promises, and no more.

    asked : points that were asked;  refusals : how often the budget was refused
    points : (dimension, n) of what was scored, a question each
    """

    _meter: Objective
    asked: int = 0
    refusals: int = 0
    points: list[Array] = field(default_factory=list)

    @property
    def dimension(self) -> int:
        return self._meter.dimension

    @property
    def budget(self) -> int:
        return self._meter.budget

    @property
    def evaluations(self) -> int:
        return self._meter.evaluations

    @property
    def linear(self) -> tuple[int, ...]:
        return self._meter.linear

    def __call__(self, point: Array) -> float:
        return self._pass(self._meter, point)

    def many(self, points: Array) -> Array:
        return self._pass(self._meter.many, points)

    def residuals(self, point: Array) -> Array:
        return self._pass(self._meter.residuals, point)

    def residual_swarm(self, points: Array) -> Array:
        return self._pass(self._meter.residual_swarm, points)

    def _pass(self, question: Callable[[Array], T], points: Array) -> T:
        columns = np.array(points, dtype=float).reshape(self.dimension, -1)
        self.points.append(columns[:, : self._meter.budget - self._meter.evaluations])
        self.asked += columns.shape[1]
        try:
            return question(points)
        except BudgetSpent:
            self.refusals += 1
            raise


@dataclass(frozen=True, eq=False)
class Search:
    """What came of a search. points : (dimension, evaluations);  spent : whether the budget's refusal ended it"""

    trace: Trace
    points: Array
    evaluations: int
    asked: int
    refusals: int
    spent: bool


def problem(model: Model) -> Problem:
    """The model on the sum of waves that TRUTH makes."""
    size = len(model.parameters)
    output = Waves(size).simulate(Record(TIME, TIME, None).signal, TRUTH[:size, None])[:, 0]
    return Problem(System(model), (Record(TIME, TIME, lock(output)),), Space(model.parameters), LOSSES["rmse"])


def watch(optimizer: Optimizer, model: Model, budget: int, seed: int = 0) -> Search:
    """Search the model's box. Raises Broken where the shared first points were written into or state was reached."""
    meter = Objective(problem(model), budget)
    objective = Watched(meter)
    first = np.random.default_rng([seed, 1]).random((max(budget, 100), objective.dimension)).T
    kept = first.copy()
    lock(first)
    try:
        optimizer.search(objective, lambda particles: first[:, :particles], np.random.default_rng([seed, 2]))
        spent = False
    except BudgetSpent:
        spent = True
    expect(np.array_equal(first, kept), "it writes into the first points, which all optimizers of a trial share.")
    expect(meter.budget == budget, f"it changes the meter's budget from {budget} to {meter.budget}.")
    points = np.concatenate([*objective.points, np.empty((objective.dimension, 0))], axis=1)
    return Search(meter.trace, points, meter.evaluations, objective.asked, objective.refusals, spent)

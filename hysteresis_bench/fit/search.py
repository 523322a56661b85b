"""One seeded search of one problem."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Optimizer, Start
from hysteresis_bench.fit.objective import BudgetSpent, Objective, OnEvaluated, Problem, Trace


@dataclass(frozen=True, eq=False)
class Search:
    """What a search found.

    values : (dimension,) in units; spent : whether the whole budget was used
    """

    values: Array
    loss: float
    evaluations: int
    spent: bool
    trace: Trace


def search(
    problem: Problem,
    optimizer: Optimizer,
    *,
    budget: int,
    start: Start,
    rng: Generator,
    on_evaluated: OnEvaluated | None = None,
) -> Search:
    """Run one optimizer on one problem. Whatever the optimizer raises passes through.

    on_evaluated : called with the count of evaluations so far
    Raises RuntimeError where the optimizer returned without a single evaluation.
    """
    objective = Objective(problem, budget, on_evaluated)
    with contextlib.suppress(BudgetSpent):
        optimizer.search(objective.shown(), start, rng)
    if objective.best_point is None:
        raise RuntimeError("the optimizer returned without evaluating anything")
    trace = objective.trace
    return Search(trace.points[-1], objective.best, objective.evaluations, objective.evaluations == budget, trace)

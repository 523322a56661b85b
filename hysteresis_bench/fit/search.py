"""One seeded search of one problem, and the local polish that finishes a fit."""

from __future__ import annotations

import contextlib
import hashlib
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator, SeedSequence, default_rng

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Optimizer, Start
from hysteresis_bench.fit.objective import BudgetSpent, Objective, Problem, Trace


def seed_of(*key: object) -> str:
    """SHA-256 of the key's parts joined by "|", as hexadecimal digits."""
    return hashlib.sha256("|".join(str(part) for part in key).encode()).hexdigest()


def generator(*key: object) -> Generator:
    """A random generator that depends on the key alone, not on order or workers."""
    return default_rng(SeedSequence(int(seed_of(*key), 16)))


def shared_start(dimension: int, *key: object) -> Start:
    """First points for all optimizers of a trial; a larger swarm begins with the smaller one."""

    def start(particles: int) -> Array:
        return np.ascontiguousarray(generator(*key).random((particles, dimension)).T)

    return start


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


def search(problem: Problem, optimizer: Optimizer, budget: int, start: Start, rng: Generator) -> Search:
    """Run one optimizer on one problem. Whatever the optimizer raises passes through.

    Raises RuntimeError where the optimizer returned without a single evaluation.
    """
    objective = Objective(problem, budget)
    with contextlib.suppress(BudgetSpent):
        optimizer.search(objective, start, rng)
    if objective.best_point is None:
        raise RuntimeError("the optimizer returned without evaluating anything")
    trace = objective.trace
    return Search(trace.points[-1], objective.best, objective.evaluations, objective.evaluations == budget, trace)


def polish(problem: Problem, values: Array) -> Array:
    """The nearest local least-squares optimum inside the box; values and result (dimension,), in units.

    Trust-region reflective (scipy) in the unit box; never worse than where it began.
    """
    from scipy.optimize import least_squares

    inside = np.clip(problem.space.to_unit(values.reshape(-1, 1))[:, 0], 1e-9, 1.0 - 1e-9)
    scale = problem.scale  # residuals of order one: the tolerances are then relative

    def residuals(point: Array) -> Array:
        return problem.residuals(np.clip(point, 0.0, 1.0)) / scale

    found = least_squares(residuals, inside, bounds=(0.0, 1.0), x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-12)
    candidates = [np.clip(found.x, 0.0, 1.0)[:, None], problem.space.to_unit(values.reshape(-1, 1))]
    losses = problem.losses(np.clip(np.hstack(candidates), 0.0, 1.0))
    best = candidates[0] if losses[0] < losses[1] else candidates[1]
    return problem.space.from_unit(best)[:, 0]

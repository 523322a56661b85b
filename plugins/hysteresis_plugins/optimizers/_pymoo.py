"""What the pymoo wrappers share: the problem, and running an algorithm on it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.random import Generator
from pymoo.core.algorithm import Algorithm
from pymoo.core.problem import Problem
from pymoo.core.termination import NoTermination
from pymoo.optimize import minimize

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective


class UnitBox(Problem):
    """The metered loss as pymoo sees it: a population at once, (particles, dimension)."""

    def __init__(self, objective: Objective) -> None:
        super().__init__(n_var=objective.dimension, n_obj=1, xl=0.0, xu=1.0)
        self.objective = objective

    def _evaluate(self, points: Array, out: dict[str, Any], *args: Any, **kwargs: Any) -> None:
        out["F"] = self.objective.many(np.clip(points, 0.0, 1.0).T)


def run(algorithm: Algorithm, objective: Objective, rng: Generator) -> None:
    """Run until the algorithm itself has nothing left to try, or the budget is spent."""
    minimize(UnitBox(objective), algorithm, NoTermination(), copy_algorithm=False, seed=int(rng.integers(2**31)))

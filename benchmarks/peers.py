"""One trial of a swarm as other libraries' users run it: a scalar objective, one particle at a time."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from hysteresis_bench.arrays import Array

Trial = Callable[[Callable[[Array], float], int, int, int], None]
"""trial(loss, dimension, particles, iterations): minimise loss(point) on the unit box."""


def pyswarms_trial(loss: Callable[[Array], float], dimension: int, particles: int, iterations: int) -> None:
    import logging

    import pyswarms

    logging.disable(logging.CRITICAL)
    swarm = pyswarms.single.GlobalBestPSO(
        particles, dimension, {"w": 0.9, "c1": 0.5, "c2": 0.5}, bounds=(np.zeros(dimension), np.ones(dimension))
    )
    swarm.optimize(lambda points: np.array([loss(point) for point in points]), iterations, verbose=False)


def pymoo_trial(loss: Callable[[Array], float], dimension: int, particles: int, iterations: int) -> None:
    from pymoo.algorithms.soo.nonconvex.pso import PSO
    from pymoo.core.problem import ElementwiseProblem
    from pymoo.optimize import minimize

    class Scalar(ElementwiseProblem):
        def _evaluate(self, x: Array, out: dict[str, float], *args: object, **kwargs: object) -> None:
            out["F"] = loss(x)

    minimize(Scalar(n_var=dimension, n_obj=1, xl=0.0, xu=1.0), PSO(particles), ("n_gen", iterations), seed=1)


TRIALS: dict[str, Trial] = {
    name: trial for name, trial in (("pyswarms", pyswarms_trial), ("pymoo", pymoo_trial)) if find_spec(name)
}

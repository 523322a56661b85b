"""BIPOP-CMA-ES: two regimes of restarts, with the CMA-ES of the package `cmaes`.

[1] N. Hansen, Benchmarking a BI-population CMA-ES on the BBOB-2009 function testbed, Proceedings of the Genetic and
    Evolutionary Computation Conference, companion (2009) 2389-2396, section 2.
[2] N. Hansen, The CMA evolution strategy: a tutorial, arXiv:1604.00772 (2016).
[3] M. Nomura, M. Shibata, cmaes: a simple yet practical Python library for CMA-ES, arXiv:2402.01373 (2024).

Legend: lambda population, sigma standard deviation as a share of a parameter's range.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, log

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Optimizer, Start


@dataclass(frozen=True)
class BipopCmaes(Optimizer):
    """Covariance matrix adaptation with two regimes of restarts (BIPOP-CMA-ES, cmaes): large and small populations.

    particles : first population; 0 takes the default of [2], 4 + floor(3 ln dimension)
    spread : first standard deviation, as a share of a parameter's range

    A run begins at the first shared point, later ones at uniform random points. Restarts alternate so that both regimes
    have spent equally: one doubles its population each time, the other draws a smaller one, and a smaller spread [1].
    Bounds: the library draws a point outside the box again, up to 100 times, then puts it on the wall. Ours: after
    so many restarts that a population exceeds what is left of the budget, the meter ends the search within it.
    """

    particles: int = 0
    spread: float = 0.25

    def __post_init__(self) -> None:
        if self.particles != 0 and self.particles < 4:
            raise ValueError(f"particles = {self.particles} must be at least 4, or 0 for the default.")
        if not 0.0 < self.spread <= 1.0:
            raise ValueError(f"spread = {self.spread} must be above 0 and at most 1.")

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        default = self.evaluations_per_iteration(objective.dimension)
        spent = {"large": 0, "small": 0}
        doublings = 0
        _descend(objective, start(1)[:, 0], default, self.spread, rng)
        while True:
            regime = "large" if spent["large"] <= spent["small"] else "small"
            if regime == "large":
                doublings += 1
                particles, spread = default * 2**doublings, self.spread  # [1] lambda_l = 2^i lambda_def
            else:
                # [1] lambda_s = lambda_def (lambda_l / (2 lambda_def))^(U²), sigma = sigma_def 10^(-2 U)
                particles = floor(default * (2**doublings / 2.0) ** (rng.random() ** 2))
                spread = self.spread * 10.0 ** (-2.0 * rng.random())
            before = objective.evaluations
            _descend(objective, rng.random(objective.dimension), particles, spread, rng)
            spent[regime] += objective.evaluations - before

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles or 4 + floor(3.0 * log(dimension))


def _descend(objective: Objective, mean: Array, particles: int, spread: float, rng: Generator) -> None:
    """One run of CMA-ES until the library's own criteria stop it; mean : (dimension,) in the unit box"""
    from cmaes import CMA

    bounds = np.tile([0.0, 1.0], (mean.size, 1))
    strategy = CMA(mean, spread, bounds, seed=int(rng.integers(2**32)), population_size=particles)
    while not strategy.should_stop():
        points = [strategy.ask() for _ in range(particles)]
        losses = objective.many(np.column_stack(points))
        strategy.tell(list(zip(points, map(float, losses), strict=True)))

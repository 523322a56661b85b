"""pymoo's CMA-ES with restarts of growing population.

[1] N. Hansen, A. Ostermeier, Completely derandomized self-adaptation in evolution strategies, Evolutionary
    Computation 9 (2001) 159-195.
[2] A. Auger, N. Hansen, A restart CMA evolution strategy with increasing population size, Proceedings of
    the Congress on Evolutionary Computation (2005) 1769-1776.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least, between


@dataclass(frozen=True)
class PymooCmaes(Optimizer):
    """Covariance matrix adaptation evolution strategy (CMA-ES, pymoo), restarted with doubled population.

    particles : size of the first population
    spread : first standard deviation, as a share of a parameter's range

    Bounds: the library's smooth transformation into the box. When it has converged it restarts from a
    uniform random point with twice the population [2].
    """

    particles: int = 50
    spread: float = 0.25

    def __post_init__(self) -> None:
        at_least(4, particles=self.particles)
        between(1e-6, 1, spread=self.spread)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from pymoo.algorithms.soo.nonconvex.cmaes import CMAES

        from hysteresis_plugins.optimizers._pymoo import run

        particles = self.particles
        for points in first_points(objective, start, rng):
            # the library's own generator is numpy's global one, unless it is given another
            algorithm = CMAES(
                x0=points[:, 0],
                sigma=self.spread,
                pop_size=particles,
                randn=lambda *shape: rng.standard_normal(shape),
            )
            run(algorithm, objective, rng)
            particles *= 2

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

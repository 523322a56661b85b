"""pymoo's differential evolution.

[1] R. Storn, K. Price, Differential evolution - a simple and efficient heuristic for global optimization
    over continuous spaces, Journal of Global Optimization 11 (1997) 341-359.
[2] J. Blank, K. Deb, pymoo: multi-objective optimization in Python, IEEE Access 8 (2020) 89497-89509.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class PymooDe(Optimizer):
    """Differential evolution with pymoo's own defaults (pymoo).

    particles : size of the population

    Bounds: a coordinate outside is drawn anew between its parent and the wall, by pymoo. Where it ends by
    itself it restarts with a uniform random population.
    """

    particles: int = 50

    def __post_init__(self) -> None:
        at_least(4, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from pymoo.algorithms.soo.nonconvex.de import DE

        from hysteresis_plugins.optimizers._pymoo import run

        for points in first_points(objective, start, rng, self.particles):
            run(DE(pop_size=self.particles, sampling=points.T), objective, rng)

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

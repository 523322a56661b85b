"""nlopt's improved stochastic ranking evolution strategy.

[1] T. P. Runarsson, X. Yao, Search biases in constrained evolutionary optimization, IEEE Transactions on
    Systems, Man, and Cybernetics C 35 (2005) 233-243.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class NloptIsres(Optimizer):
    """Evolution strategy with stochastic ranking (ISRES, nlopt).

    particles : size of the population; 0 leaves it to nlopt: 20 (dimension + 1)

    Bounds: a mutated coordinate outside is drawn anew, by nlopt. The shared first point is one of the population.
    """

    particles: int = 0

    def __post_init__(self) -> None:
        at_least(0, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import Search

        search = Search("GN_ISRES", objective, rng)
        search.nlopt.set_population(self.particles)
        for points in first_points(objective, start, rng):
            search.run(points[:, 0])

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles or 20 * (dimension + 1)

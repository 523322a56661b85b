"""nlopt's controlled random search.

[1] P. Kaelo, M. M. Ali, Some variants of the controlled random search algorithm for global optimization,
    Journal of Optimization Theory and Applications 130 (2006) 253-264.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class NloptCrs2(Optimizer):
    """Controlled random search with local mutation (CRS2, nlopt).

    particles : size of the population; 0 leaves it to nlopt: 10 (dimension + 1); else above the dimension

    Bounds: a trial point outside is put on the wall, by nlopt. The shared first point is one of the population.
    """

    particles: int = 0

    def __post_init__(self) -> None:
        at_least(0, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import Search

        if 0 < self.particles <= objective.dimension:
            raise ValueError(f"particles = {self.particles} must be above the number of parameters.")
        search = Search("GN_CRS2_LM", objective, rng)
        search.nlopt.set_population(self.particles)
        for points in first_points(objective, start, rng):
            search.run(points[:, 0])

"""nlopt's evolutionary algorithm ESCH.

[1] C. H. da Silva Santos, M. S. Goncalves, H. E. Hernandez-Figueroa, Designing novel photonic devices by
    bio-inspired computing, IEEE Photonics Technology Letters 22 (2010) 1177-1179.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class NloptEsch(Optimizer):
    """Evolutionary algorithm with Cauchy mutation (ESCH, nlopt).

    particles : size of the population; 0 leaves it to nlopt: 40

    Bounds: a mutated coordinate outside is drawn anew, by nlopt. The shared first point is one of the population.
    """

    particles: int = 0

    def __post_init__(self) -> None:
        at_least(0, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import Search

        search = Search("GN_ESCH", objective, rng)
        search.nlopt.set_population(self.particles)
        for points in first_points(objective, start, rng):
            search.run(points[:, 0])

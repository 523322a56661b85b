"""pymoo's particle swarm with adaptive coefficients.

[1] Z.-H. Zhan, J. Zhang, Y. Li, H. S.-H. Chung, Adaptive particle swarm optimization, IEEE Transactions on
    Systems, Man, and Cybernetics B 39 (2009) 1362-1381.
[2] J. Blank, K. Deb, pymoo: multi-objective optimization in Python, IEEE Access 8 (2020) 89497-89509.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class PymooPso(Optimizer):
    """Particle swarm with adaptive coefficients and a perturbed leader (pymoo).

    particles : size of the swarm

    Bounds: a move that leaves the box is drawn again, by pymoo. Where it ends by itself it restarts with
    a uniform random swarm.
    """

    particles: int = 50

    def __post_init__(self) -> None:
        at_least(2, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from pymoo.algorithms.soo.nonconvex.pso import PSO

        from hysteresis_plugins.optimizers._pymoo import run

        for points in first_points(objective, start, rng, self.particles):
            run(PSO(pop_size=self.particles, sampling=points.T), objective, rng)

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

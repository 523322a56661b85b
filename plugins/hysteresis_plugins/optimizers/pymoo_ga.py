"""pymoo's genetic algorithm.

[1] K. Deb, R. B. Agrawal, Simulated binary crossover for continuous search space, Complex Systems 9 (1995)
    115-148.
[2] J. Blank, K. Deb, pymoo: multi-objective optimization in Python, IEEE Access 8 (2020) 89497-89509.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class PymooGa(Optimizer):
    """Genetic algorithm with simulated binary crossover and polynomial mutation (pymoo).

    particles : size of the population and of the offspring

    Bounds: its operators create no child outside, by pymoo. Where it finds no child that is new, it
    restarts with a uniform random population.
    """

    particles: int = 50

    def __post_init__(self) -> None:
        at_least(2, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from pymoo.algorithms.soo.nonconvex.ga import GA

        from hysteresis_plugins.optimizers._pymoo import run

        for points in first_points(objective, start, rng, self.particles):
            run(GA(pop_size=self.particles, sampling=points.T), objective, rng)

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

"""scipy's differential evolution.

[1] R. Storn, K. Price, Differential evolution - a simple and efficient heuristic for global optimization
    over continuous spaces, Journal of Global Optimization 11 (1997) 341-359.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import at_least, between


@dataclass(frozen=True)
class ScipyDifferentialEvolution(Optimizer):
    """Differential evolution (scipy), a generation at a time.

    particles : size of the population
    mutation_low, mutation_high : the weight of the difference vectors is drawn between them each generation
    recombination : share of coordinates taken from the mutant
    strategy : which vectors are combined, by scipy's names

    Bounds: a coordinate outside is drawn anew in the box, by scipy. Where the whole population has the
    same loss it restarts with a uniform random population. No polishing at the end.
    """

    particles: int = 50
    mutation_low: float = 0.5
    mutation_high: float = 1.0
    recombination: float = 0.7
    strategy: Literal["best1bin", "rand1bin", "best2bin", "rand2bin", "currenttobest1bin", "randtobest1bin"] = (
        "best1bin"
    )

    def __post_init__(self) -> None:
        at_least(5, particles=self.particles)
        between(0, 1.99, mutation_low=self.mutation_low, mutation_high=self.mutation_high)
        between(0, 1, recombination=self.recombination)
        if self.mutation_low > self.mutation_high:
            raise ValueError(f"mutation_low = {self.mutation_low} is above mutation_high = {self.mutation_high}.")

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import differential_evolution

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, box

        for points in first_points(objective, start, rng, self.particles):
            differential_evolution(
                objective.many,
                box(objective),
                init=points.T,
                strategy=self.strategy,
                mutation=(self.mutation_low, self.mutation_high),
                recombination=self.recombination,
                vectorized=True,
                updating="deferred",
                polish=False,
                tol=0.0,
                maxiter=UNLIMITED,
                rng=rng,
            )

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

"""The textbook particle swarm: constriction coefficients, global best.

[1] M. Clerc, J. Kennedy, The particle swarm - explosion, stability, and convergence in a multidimensional
    complex space, IEEE Transactions on Evolutionary Computation 6 (2002) 58-73.
[2] R. C. Eberhart, Y. Shi, Comparing inertia weights and constriction factors in particle swarm
    optimization, Proceedings of the Congress on Evolutionary Computation (2000) 84-88.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, positive
from hysteresis_plugins.optimizers._swarm import Swarm


@dataclass(frozen=True)
class PsoConstriction(Optimizer):
    """Particle swarm with Clerc and Kennedy's constriction coefficients, the textbook reference.

    particles : size of the swarm
    attraction : φ, the sum of both pulls, above 4; 4.1 gives χ = 0.7298 and c1 = c2 = χ φ/2 = 1.4962
    speed_limit : largest velocity as a share of a parameter's range; half of it by [2]

    Bounds: a particle that would leave the box stops on its wall with no velocity across it.
    Ours: first velocities uniform within the speed limit.
    """

    particles: int = 50
    attraction: float = 4.1
    speed_limit: float = 0.5

    def __post_init__(self) -> None:
        at_least(1, particles=self.particles)
        positive(speed_limit=self.speed_limit)
        if not self.attraction > 4.0:
            raise ValueError(f"attraction = {self.attraction} must be above 4, where the swarm contracts.")

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        phi = self.attraction
        chi = 2.0 / (phi - 2.0 + sqrt(phi**2 - 4.0 * phi))  # [1] (4.15) with κ = 1
        swarm = Swarm.scattered(start, rng, self.particles, self.speed_limit)
        while True:
            swarm.evaluate(objective)
            swarm.move(chi, chi * phi / 2.0, chi * phi / 2.0, rng)

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

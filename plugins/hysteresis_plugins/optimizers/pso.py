"""The basic particle swarm of the SMA paper.

[1] Jiles-Atherton Based Hysteresis Identification of Shape Memory Alloy-Actuating Compliant Mechanism
    via Modified Particle Swarm Optimization Algorithm, section 4.1, equations (13) to (19).

Legend: Λ inertia, c1 cognitive, c2 social, p_i a particle's best, p_g the leader, R1 and R2 diagonal
matrices of random numbers, so independent in every coordinate.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, positive
from hysteresis_plugins.optimizers._swarm import Swarm


@dataclass(frozen=True)
class Pso(Optimizer):
    """Particle swarm with constant coefficients, as the SMA paper compares itself with.

    particles : size of the swarm
    inertia, cognitive, social : Λ, c1, c2
    speed_limit : largest velocity as a share of a parameter's range
    accuracy : the search ends when the best loss, in the loss's own unit, is below this

    Bounds: a particle that would leave the box stops on its wall with no velocity across it. The paper
    gives this rule for the modified algorithm (step 3); ours: here too, where it gives none.
    Ours: first velocities by (27), which the paper also gives for the modified algorithm only.
    """

    particles: int = 50
    inertia: float = 0.9
    cognitive: float = 0.5
    social: float = 0.5
    speed_limit: float = 0.15
    accuracy: float = 1e-7

    def __post_init__(self) -> None:
        at_least(1, particles=self.particles)
        at_least(0, inertia=self.inertia, cognitive=self.cognitive, social=self.social, accuracy=self.accuracy)
        positive(speed_limit=self.speed_limit)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        swarm = Swarm.scattered(start, rng, self.particles, self.speed_limit)  # [1] (13), (14), (16)
        swarm.evaluate(objective)  # [1] (18), (19)
        while swarm.leader_loss >= self.accuracy:
            swarm.move(self.inertia, self.cognitive, self.social, rng)  # [1] (17), (15)
            swarm.evaluate(objective)

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

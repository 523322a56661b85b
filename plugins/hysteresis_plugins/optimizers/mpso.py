"""The modified particle swarm of the SMA paper.

[1] Jiles-Atherton Based Hysteresis Identification of Shape Memory Alloy-Actuating Compliant Mechanism
    via Modified Particle Swarm Optimization Algorithm, sections 4.2 and 4.3, equations (21) to (28),
    steps 1 to 6.

Legend: Λ inertia, c1 cognitive, c2 social, n iteration, Ξ their number, D dimension, p_i a particle's
best, p_g the leader.

What the paper leaves open:
- ours: n runs from 1 to Ξ, so that there are Ξ iterations and the last one uses Λ_min. (Step 5 goes on
  while n ≤ Ξ, step 6 ends at n ≥ Ξ.)
- ours: Ξ is what the budget affords after the first swarm; 300 at the paper's 15 050 evaluations. A rest
  smaller than a swarm is spent on a part of one more iteration with the coefficients of n = Ξ.
- ours: step 2 prints "> 1e-7, go to Step 6"; step 6 shows that < is meant.
- ours: a mutated particle keeps its velocity, and the leader's particle may mutate like any other; the
  bests are kept aside, so nothing is lost.
- ours: the mutation threshold is 0.95, as the rule in step 4 prints it; the text below it says 0.8.
- ours: v_min = -v_max, as the text of section 4.1 bounds the velocity.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, between, positive
from hysteresis_plugins.optimizers._swarm import Swarm


@dataclass(frozen=True)
class Mpso(Optimizer):
    """Particle swarm with falling inertia, turning coefficients and random mutation, from the SMA paper.

    particles : size of the swarm
    inertia_first, inertia_last : Λ_max and Λ_min
    cognitive_first, cognitive_last : c1_ini and c1_end
    social_first, social_last : c2_ini and c2_end
    speed_limit : largest velocity as a share of a parameter's range
    mutation_threshold : a particle mutates where a uniform random number exceeds this
    accuracy : the search ends when the best loss, in the loss's own unit, is below this

    Bounds: a particle that would leave the box stops on its wall with no velocity across it (step 3).
    """

    anytime = False

    particles: int = 50
    inertia_first: float = 0.9
    inertia_last: float = 0.4
    cognitive_first: float = 2.5
    cognitive_last: float = 1.3
    social_first: float = 0.5
    social_last: float = 1.7
    speed_limit: float = 0.15
    mutation_threshold: float = 0.95
    accuracy: float = 1e-7

    def __post_init__(self) -> None:
        at_least(1, particles=self.particles)
        at_least(0, cognitive_first=self.cognitive_first, cognitive_last=self.cognitive_last)
        at_least(0, social_first=self.social_first, social_last=self.social_last, accuracy=self.accuracy)
        positive(inertia_last=self.inertia_last, speed_limit=self.speed_limit)
        between(0, 1, mutation_threshold=self.mutation_threshold)
        if not self.inertia_first > self.inertia_last:
            raise ValueError(f"inertia_first = {self.inertia_first} must be above inertia_last = {self.inertia_last}.")

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        iterations = max(1, (objective.budget - self.particles) // self.particles)
        swarm = Swarm.scattered(start, rng, self.particles, self.speed_limit)  # step 1: [1] (26), (27)
        swarm.evaluate(objective)  # step 2: [1] (28)
        for n in count(1):
            if swarm.leader_loss < self.accuracy:  # step 6
                return
            swarm.move(*self.coefficients(min(n, iterations), iterations), rng)  # step 3: [1] (21), (22)
            self.mutate(swarm, rng)  # step 4
            swarm.evaluate(objective)  # step 5

    def coefficients(self, n: int, iterations: int) -> tuple[float, float, float]:
        """Λ, c1 and c2 in iteration n of so many."""
        inertia = self.inertia_first - (self.inertia_first - self.inertia_last) * n / iterations  # [1] (23)
        remaining = (inertia - self.inertia_last) / (self.inertia_first - self.inertia_last)
        turn = np.exp(-70.0 * remaining**6)
        cognitive = self.cognitive_first - (self.cognitive_first - self.cognitive_last) * turn  # [1] (24)
        social = self.social_first - (self.social_first - self.social_last) * turn  # [1] (25)
        return inertia, float(cognitive), float(social)

    def mutate(self, swarm: Swarm, rng: Generator) -> None:
        """Step 4: one coordinate of some particles anywhere in its range."""
        dimension, particles = swarm.position.shape
        rand3, rand4, rand5 = rng.random((3, particles))
        chosen = np.nonzero(rand3 > self.mutation_threshold)[0]
        # j = ⌈D rand4⌉ counts from 1; the floor counts from 0 and is also defined at rand4 = 0
        coordinate = (dimension * rand4[chosen]).astype(int)
        swarm.position[coordinate, chosen] = rand5[chosen]

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

"""G-Pmix, the particle swarm genetic hybrid of the PEA paper.

[1] The PEA paper, section 3.1: steps 1 to 7, equations (7) to (11), Table 1.

Legend: S particles, T PSO iterations a cycle, c1s to c1f cognitive, c2s to c2f social, omega_max to omega_min
inertia, Pc and Pm probabilities of crossover and mutation, Pbest a particle's best point, Gbest the leader,
M_k the number of particles better than the mean.

What the paper leaves open, ours:
- t counts the T iterations of a cycle, so that every cycle begins wide and ends narrow. (Over Maxgen, the
  swarm would still be unstable, omega 0.9 with c1 + c2 = 5, for most of the run.)
- The first velocities are uniform within the limit, which is 0.2 of a parameter's range; a particle that
  would leave the box stops on its wall, with no velocity across it.
- A particle enters the GA step as its Pbest, whose fitness it has; the M_k better ones fly on as they were. With
  `enters = "position"` the step is read to the letter: the population is where the particles are.
- The operators are those of `ga`: random pairs exchange genes, a gene that mutates is drawn anew.
- A child that neither operator touched is its parent and is neither evaluated nor entered twice.
- A child that survives takes a particle's place at rest, and its own point is its Pbest; to the letter, where
  neither is named, it keeps the velocity and the Pbest of the place, unless its own point is better.
- Maxgen counts PSO iterations; the budget is what ends the run. 4000 iterations of 50 with the first swarm are
  200 050 evaluations, and the 40 GA steps add at most 50 each.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, between, positive
from hysteresis_plugins.optimizers._swarm import Swarm
from hysteresis_plugins.optimizers.ga import exchanged, mutated

BEST, POSITION = "best", "position"


@dataclass(frozen=True)
class Gpmix(Optimizer):
    """Particle swarm whose worse half is crossed and mutated by a genetic step every 100 iterations.

    particles : S
    cycle : T, PSO iterations before a GA step
    cognitive, social, inertia : (first, last) c1, c2 and omega of a cycle
    crossover_probability, mutation_probability : Pc, Pm
    speed_limit : largest velocity as a share of a parameter's range
    enters : what of a particle the GA step takes: its "best" or its "position"
    accuracy : the search ends when the best loss, in the loss's own unit, is at most this after a cycle
    """

    particles: int = 50
    cycle: int = 100
    cognitive: tuple[float, float] = (4.0, 1.0)
    social: tuple[float, float] = (1.0, 4.0)
    inertia: tuple[float, float] = (0.9, 0.4)
    crossover_probability: float = 0.2
    mutation_probability: float = 0.2
    speed_limit: float = 0.2
    accuracy: float = 1e-5
    enters: str = "best"

    def __post_init__(self) -> None:
        at_least(2, particles=self.particles)
        at_least(1, cycle=self.cycle)
        at_least(0, accuracy=self.accuracy)
        if self.enters not in (BEST, POSITION):
            raise ValueError(f'enters = "{self.enters}" must be "{BEST}" or "{POSITION}".')
        positive(speed_limit=self.speed_limit)
        between(0, 1, crossover_probability=self.crossover_probability, mutation_probability=self.mutation_probability)
        for name, values in (("cognitive", self.cognitive), ("social", self.social), ("inertia", self.inertia)):
            if len(values) != 2:
                raise ValueError(f"{name} = {values} must be two numbers: first and last.")
            at_least(0, **{f"{name}[0]": values[0], f"{name}[1]": values[1]})

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        swarm = Swarm.scattered(start, rng, self.particles, self.speed_limit)  # step 1
        swarm.evaluate(objective)
        while swarm.leader_loss > self.accuracy:  # step 2
            for iteration in range(self.cycle):
                inertia, cognitive, social = self.coefficients(iteration)
                swarm.move(inertia, cognitive, social, rng)  # (8), (7)
                swarm.evaluate(objective)
            self.evolve(swarm, objective, rng)  # steps 3 to 6

    def coefficients(self, iteration: int) -> tuple[float, float, float]:
        """(omega, c1, c2) of an iteration of the cycle, counted from 0."""
        share = iteration / self.cycle  # t / T
        c1 = share * (self.cognitive[1] - self.cognitive[0]) + self.cognitive[0]  # (9)
        c2 = share * (self.social[1] - self.social[0]) + self.social[0]  # (10)
        omega = self.inertia[0] - (self.inertia[0] - self.inertia[1]) * share  # (11)
        return omega, c1, c2

    def evolve(self, swarm: Swarm, objective: Objective, rng: Generator) -> None:
        """The GA step: cross and mutate what is no better than the mean, keep the best of before and after."""
        at_best = self.enters == BEST
        points, known = (swarm.best, swarm.best_loss) if at_best else (swarm.position, swarm.loss)
        order = np.argsort(known, kind="stable")  # step 3
        worse = order[known[order] >= known.mean()]
        parents = points[:, worse]
        children = mutated(  # step 4
            exchanged(parents, self.crossover_probability, rng), self.mutation_probability, rng
        )
        children = children[:, np.any(children != parents, axis=0)]
        if children.shape[1] == 0:
            return
        losses = objective.many(children)
        ranks = np.argsort(np.concatenate([known[worse], losses]), kind="stable")[: worse.size]  # step 5
        born = ranks[ranks >= worse.size] - worse.size
        gone = np.delete(worse, ranks[ranks < worse.size])
        swarm.position[:, gone] = children[:, born]  # step 6
        if at_best:
            swarm.velocity[:, gone] = 0.0
        new = at_best | (losses[born] < swarm.best_loss[gone])
        swarm.best[:, gone[new]] = children[:, born[new]]
        swarm.best_loss[gone[new]] = losses[born[new]]
        winner = int(np.argmin(losses))
        if losses[winner] < swarm.leader_loss:
            swarm.leader, swarm.leader_loss = children[:, winner : winner + 1].copy(), float(losses[winner])

    def evaluations_per_iteration(self, dimension: int) -> int:
        """A PSO iteration; the GA step adds less than one more in a cycle."""
        return self.particles

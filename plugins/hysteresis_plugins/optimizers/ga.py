"""A real-coded genetic algorithm, as the PEA paper compares itself with.

[1] Modeling of piezoelectric actuators with a particle swarm genetic hybrid (the PEA paper), section 3.1.

The paper names selection, crossover with probability Pc and mutation with probability Pm, and real coding; it
gives neither the operators nor the settings of its GA column. Ours: its Table 1 values of S, Pc and Pm, and
the operators below.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, between


@dataclass(frozen=True)
class Ga(Optimizer):
    """Real-coded genetic algorithm: tournament selection, gene exchange, uniform mutation, one elite.

    particles : S, size of the population
    crossover_probability : Pc, a pair exchanges genes
    mutation_probability : Pm, a gene is redrawn
    accuracy : the search ends when the best loss, in the loss's own unit, is at most this

    Ours: parents win tournaments of two; the best so far takes the place of the worst child. Bounds: every
    operator stays in the box.
    """

    particles: int = 50
    crossover_probability: float = 0.2
    mutation_probability: float = 0.2
    accuracy: float = 1e-5

    def __post_init__(self) -> None:
        at_least(2, particles=self.particles)
        at_least(0, accuracy=self.accuracy)
        between(0, 1, crossover_probability=self.crossover_probability, mutation_probability=self.mutation_probability)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        population = np.array(start(self.particles))
        losses = objective.many(population)
        while losses.min() > self.accuracy:
            elite, elite_loss = population[:, losses.argmin()].copy(), losses.min()
            rivals = rng.integers(self.particles, size=(2, self.particles))
            parents = np.where(losses[rivals[0]] <= losses[rivals[1]], rivals[0], rivals[1])
            population = exchanged(population[:, parents], self.crossover_probability, rng)
            population = mutated(population, self.mutation_probability, rng)
            losses = objective.many(population)
            if losses.min() > elite_loss:
                population[:, losses.argmax()] = elite
                losses[losses.argmax()] = elite_loss

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles


def exchanged(points: Array, probability: float, rng: Generator) -> Array:
    """Crossover: random pairs exchange genes. points : (dimension, particles) -> same shape.

    Ours: with this probability a pair exchanges each gene with probability 1/2; of an odd number of
    particles one stays alone.
    """
    dimension, particles = points.shape
    pairs = particles // 2
    order = rng.permutation(particles)
    mothers, fathers = order[:pairs], order[pairs : 2 * pairs]
    swap = (rng.random(pairs) < probability) & (rng.random((dimension, pairs)) < 0.5)
    children = points.copy()
    children[:, mothers] = np.where(swap, points[:, fathers], points[:, mothers])
    children[:, fathers] = np.where(swap, points[:, mothers], points[:, fathers])
    return children


def mutated(points: Array, probability: float, rng: Generator) -> Array:
    """Mutation: each gene with this probability. Ours: it is drawn anew, uniformly in the box."""
    return np.where(rng.random(points.shape) < probability, rng.random(points.shape), points)

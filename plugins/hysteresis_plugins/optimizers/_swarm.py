"""A bounded synchronous particle swarm: the state and the moves that the PSO family shares."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Start


@dataclass(eq=False)
class Swarm:
    """Particles that move, and are evaluated, all at once in the unit box.

    position, velocity : (dimension, particles)
    speed_limit : largest |velocity| of a coordinate; the box is 1 wide
    best, best_loss : the best point that each particle has visited, (dimension, particles), and its loss, (particles,)
    leader, leader_loss : the best point that any has visited, (dimension, 1), and its loss
    loss : of the positions, (particles,), once evaluated

    Bounds: a particle that would leave the box stops on its wall, with no velocity in that coordinate.
    """

    position: Array
    velocity: Array
    speed_limit: float
    best: Array
    best_loss: Array
    leader: Array
    leader_loss: float = np.inf
    loss: Array = field(default_factory=lambda: np.empty(0))

    @classmethod
    def scattered(cls, start: Start, rng: Generator, particles: int, speed_limit: float) -> Swarm:
        """The shared first points, with velocities uniform in ± speed_limit; not evaluated yet."""
        position = np.array(start(particles))
        velocity = speed_limit * (2.0 * rng.random(position.shape) - 1.0)
        return cls(position, velocity, speed_limit, position.copy(), np.full(particles, np.inf), position[:, :1].copy())

    def evaluate(self, objective: Objective) -> None:
        """Score all particles; update what each, and what the swarm, knows as best. Ties change nothing."""
        self.loss = losses = objective.many(self.position)
        better = losses < self.best_loss
        self.best = np.where(better, self.position, self.best)
        self.best_loss = np.where(better, losses, self.best_loss)
        winner = int(np.argmin(losses))
        if losses[winner] < self.leader_loss:
            self.leader = self.position[:, winner : winner + 1].copy()
            self.leader_loss = float(losses[winner])

    def move(self, inertia: float, cognitive: float, social: float, rng: Generator) -> None:
        """One step of every particle: pulled to its own best and to the leader's, inside the box."""
        to_best = rng.random(self.position.shape) * (self.best - self.position)
        to_leader = rng.random(self.position.shape) * (self.leader - self.position)
        velocity = inertia * self.velocity + cognitive * to_best + social * to_leader
        velocity = np.minimum(np.maximum(velocity, -self.speed_limit), self.speed_limit)
        free = self.position + velocity
        self.position = np.minimum(np.maximum(free, 0.0), 1.0)
        self.velocity = np.where(self.position == free, velocity, 0.0)

"""The improved chaotic particle swarm of the magnetostrictive actuator's paper.

[1] Chang G., Zhang Y., Parameter Identification of GMA Nonlinear Dynamics Model Based on ICPSO,
    section III, equations (8) to (18), steps 1 to 7 (the paper's numbering has no step 5).

Legend: w inertia, c1 cognitive, c2 social, T flight time, T0 its first value, k how much of it is lost,
t iteration, t_max their number (M1), M2 steps of the chaos search, Z chaotic variable, mu its parameter.

What the paper leaves open:
- ours: all numbers but mu = 4, for which the map is chaotic on [0, 1]. w, c1 and c2 are the constriction
  coefficients of Clerc and Kennedy, 2002; the speed limit is the SMA paper's.
- ours: of three candidates the best becomes the position, and the velocity that led there the velocity.
- ours: r1 and r2 are drawn for every particle and coordinate.
- ours: t runs from 0 to t_max - 1, so that the first flight lasts T0. t_max is what the budget affords
  after the first swarm; a rest smaller than an iteration is spent with the last T.
- ours: x_min and x_max in (17) and (18) are the walls of the box, the value range of step 1.
- ours: Z_1 is gbest itself and has been evaluated; the M2 points tried are the ones after it.
- ours: from the same gbest the map would try the same points again. While gbest stands, the sequence
  goes on where it stopped.
- ours: step 6 draws the particle that is replaced; it keeps its velocity and what it knows as its best.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, between, positive

DEAD = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
"""Where the logistic map with mu = 4 comes to rest: its fixed points 0 and 3/4, and what it sends there."""


@dataclass(frozen=True)
class Icpso(Optimizer):
    """Particle swarm with three trial flights a particle, shrinking flight time and a chaos search.

    particles : size of the swarm
    inertia, cognitive, social : w, c1, c2
    flight_time : T0
    shortening : k, the share of T0 that is lost over the search
    chaos_steps : M2
    logistic : mu
    speed_limit : largest velocity as a share of a parameter's range
    accuracy : the search ends when the best loss, in the loss's own unit, is below this

    Bounds: a candidate that would leave the box stops on its wall, with no velocity across it. A gbest on
    a wall is a dead point of the logistic map: the chaos search then begins a little inside.
    One iteration costs three evaluations a particle and the chaos steps.
    """

    anytime = False

    particles: int = 50
    inertia: float = 0.7298
    cognitive: float = 1.496
    social: float = 1.496
    flight_time: float = 1.0
    shortening: float = 0.5
    chaos_steps: int = 50
    logistic: float = 4.0
    speed_limit: float = 0.15
    accuracy: float = 1e-12

    def __post_init__(self) -> None:
        at_least(1, particles=self.particles, chaos_steps=self.chaos_steps)
        at_least(0, inertia=self.inertia, cognitive=self.cognitive, social=self.social, accuracy=self.accuracy)
        positive(flight_time=self.flight_time, speed_limit=self.speed_limit, logistic=self.logistic)
        between(0, 1, shortening=self.shortening)
        between(0, 4, logistic=self.logistic)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        iterations = max(1, (objective.budget - self.particles) // (3 * self.particles + self.chaos_steps))
        position = np.array(start(self.particles))  # step 1
        velocity = self.speed_limit * (2.0 * rng.random(position.shape) - 1.0)
        best, best_loss = position.copy(), objective.many(position)  # step 2
        leader, leader_loss = self.leading(best, best_loss)
        chaos = leader
        for t in count():
            if leader_loss < self.accuracy:  # step 7
                return
            flight = self.time_of_flight(min(t, iterations - 1), iterations)
            candidates, velocities = self.candidates(position, velocity, best, leader, flight, rng)  # step 3
            losses = objective.many(np.hstack(candidates)).reshape(3, self.particles)
            chosen = np.argmin(losses, axis=0)
            position, velocity = picked(candidates, chosen), picked(velocities, chosen)
            reached = losses[chosen, np.arange(self.particles)]
            best = np.where(reached < best_loss, position, best)
            best_loss = np.minimum(reached, best_loss)
            if best_loss.min() < leader_loss:
                leader, leader_loss = self.leading(best, best_loss)
                chaos = leader  # (17): the unit box is the map's own interval
            sequence = self.chaotic_sequence(chaos, rng)  # step 4
            chaos_losses = objective.many(sequence)
            chaos = sequence[:, -1:]
            winner = int(np.argmin(chaos_losses))
            found, found_loss = sequence[:, winner], float(chaos_losses[winner])
            replaced = rng.integers(self.particles)
            position[:, replaced] = found  # step 6
            if found_loss < best_loss[replaced]:
                best[:, replaced], best_loss[replaced] = found, found_loss
            if found_loss < leader_loss:
                leader, leader_loss = found[:, None].copy(), found_loss
                chaos = leader

    def time_of_flight(self, t: int, iterations: int) -> float:
        """T in iteration t of so many."""
        return self.flight_time * (1.0 - self.shortening * t / iterations)  # (14)

    def candidates(
        self, position: Array, velocity: Array, best: Array, leader: Array, flight: float, rng: Generator
    ) -> tuple[list[Array], list[Array]]:
        """The three positions tried, inside the box, and their velocities; (dimension, particles) each."""
        v1 = self.inertia * velocity  # (8)
        v2 = v1 + self.cognitive * rng.random(position.shape) * (best - position)  # (9)
        v3 = v2 + self.social * rng.random(position.shape) * (leader - position)  # (10)
        limited = [np.clip(v, -self.speed_limit, self.speed_limit) for v in (v1, v2, v3)]
        free = [position + flight * v for v in limited]  # (11), (12), (13)
        inside = [np.clip(x, 0.0, 1.0) for x in free]
        return inside, [np.where(x == y, v, 0.0) for x, y, v in zip(free, inside, limited, strict=True)]

    def chaotic_sequence(self, seed: Array, rng: Generator) -> Array:
        """The M2 points after the seed: (dimension, 1) -> (dimension, chaos_steps), inside the unit box."""
        z = seed
        points = []
        for _ in range(self.chaos_steps):
            z = alive(z, rng)
            z = self.logistic * z * (1.0 - z)  # (15)
            points.append(z)
        return np.hstack(points)  # (18): the unit box is the map's own interval

    @staticmethod
    def leading(best: Array, best_loss: Array) -> tuple[Array, float]:
        """The best of the bests, (dimension, 1), and its loss."""
        winner = int(np.argmin(best_loss))
        return best[:, winner : winner + 1].copy(), float(best_loss[winner])

    def evaluations_per_iteration(self, dimension: int) -> int:
        return 3 * self.particles + self.chaos_steps


def alive(z: Array, rng: Generator) -> Array:
    """z moved off the points where the logistic map would come to rest; ours: by 1e-4 to 1e-3, at random."""
    dead = np.min(np.abs(z[..., None] - DEAD), axis=-1) < 1e-6
    shift = rng.uniform(1e-4, 1e-3, z.shape)
    return np.where(dead, np.where(z < 0.5, z + shift, z - shift), z)


def picked(options: list[Array], chosen: Array) -> Array:
    """Column j of options[chosen[j]]: (dimension, particles)."""
    rows: Array = np.take_along_axis(np.stack(options), chosen[None, None, :], axis=0)[0]
    return rows

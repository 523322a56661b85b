"""Uniform random search, the floor that every optimizer must beat."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class RandomSearch(Optimizer):
    """Uniform random points in the box, the floor that every optimizer must beat.

    particles : points evaluated at once; the first ones are shared by all optimizers
    """

    particles: int = 50

    def __post_init__(self) -> None:
        at_least(1, particles=self.particles)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        points = start(self.particles)
        while True:
            objective.many(points)
            points = rng.random(points.shape)

"""Restarts: where a search begins again when it ends before the budget does."""

from __future__ import annotations

from collections.abc import Iterator

from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Start


def first_points(objective: Objective, start: Start, rng: Generator, particles: int = 1) -> Iterator[Array]:
    """The shared first points, then fresh uniform ones for as long as there are searches to begin.

    -> (dimension, particles) each time. Ends after a search that evaluated nothing, which would
    otherwise begin again for ever.
    """
    points = start(particles)
    while True:
        before = objective.evaluations
        yield points
        if objective.evaluations == before:
            return
        points = rng.random((objective.dimension, particles))

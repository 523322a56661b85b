"""Optimizers that misbehave, each in one way, registered as a third party's would be."""

import contextlib
import os
import time
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.contracts import Optimizer


@dataclass(frozen=True)
class Raises(Optimizer):
    """Raises after a few evaluations."""

    def search(self, objective, start, rng):
        objective.many(start(5))
        raise ZeroDivisionError("the swarm has no diameter")


@dataclass(frozen=True)
class Returns(Optimizer):
    """Returns after seven evaluations."""

    def search(self, objective, start, rng):
        objective.many(start(7))


@dataclass(frozen=True)
class Empty(Optimizer):
    """Returns at once."""

    def search(self, objective, start, rng):
        pass


@dataclass(frozen=True)
class Outside(Optimizer):
    """Proposes a point outside the box."""

    def search(self, objective, start, rng):
        objective(np.full(objective.dimension, 1.5))


@dataclass(frozen=True)
class Hangs(Optimizer):
    """Never returns."""

    def search(self, objective, start, rng):
        objective.many(start(5))
        while True:
            time.sleep(1)


@dataclass(frozen=True)
class Dies(Optimizer):
    """Takes its process with it."""

    def search(self, objective, start, rng):
        os._exit(7)


@dataclass(frozen=True)
class Greedy(Optimizer):
    """Asks for more memory than there is."""

    def search(self, objective, start, rng):
        np.ones((1 << 40,))


@dataclass(frozen=True)
class Stubborn(Optimizer):
    """Catches everything that is an Exception and goes on."""

    def search(self, objective, start, rng):
        while True:
            with contextlib.suppress(Exception):
                objective.many(rng.random((objective.dimension, 16)))


@dataclass(frozen=True)
class Abstract(Optimizer):
    """Has no search."""


class Alien:
    """Is no optimizer."""

"""Optimizers that break one promise each."""

import itertools
import random
import sys
import threading
import time
from dataclasses import dataclass, field

import numpy as np

from hysteresis_bench.contracts import Optimizer


class Searches(Optimizer):
    """Uniform random points; the others change one thing in it."""

    def first(self, objective, start, rng):
        return start(10)

    def points(self, objective, rng):
        return rng.random((objective.dimension, 10))

    def search(self, objective, start, rng):
        points = self.first(objective, start, rng)
        while True:
            objective.many(points)
            points = self.points(objective, rng)


@dataclass(frozen=True)
class GoesOn(Searches):
    """Catches the refusal and asks again."""

    def search(self, objective, start, rng):
        for _ in range(200):
            try:
                objective.many(rng.random((objective.dimension, 10)))
            except BaseException:
                continue


@dataclass(frozen=True)
class Outside(Searches):
    """Steps out of the box."""

    def points(self, objective, rng):
        return 1.01 * rng.random((objective.dimension, 10))


@dataclass(frozen=True)
class Unseeded(Searches):
    """Has random numbers of its own."""

    def points(self, objective, rng):
        return np.random.default_rng().random((objective.dimension, 10))


@dataclass(frozen=True)
class Global(Searches):
    """Draws from numpy's global generator."""

    def points(self, objective, rng):
        return np.random.random((objective.dimension, 10))  # noqa: NPY002


@dataclass(frozen=True)
class Reseeds(Searches):
    """Seeds Python's global generator."""

    def first(self, objective, start, rng):
        random.seed(1)
        return start(10)


@dataclass(frozen=True)
class Overwrites(Searches):
    """Writes into the shared first points."""

    def first(self, objective, start, rng):
        points = start(10)
        points.setflags(write=True)
        points *= 0.5
        return points


@dataclass(frozen=True)
class Buys(Searches):
    """Wants a larger budget."""

    def first(self, objective, start, rng):
        objective.budget *= 5
        return start(10)


@dataclass(frozen=True)
class Remembers(Searches):
    """Goes on where the search before it ended."""

    kept: dict = field(default_factory=dict)

    def first(self, objective, start, rng):
        return self.kept.get(objective.dimension, start(10))

    def points(self, objective, rng):
        points = rng.random((objective.dimension, 10))
        self.kept[objective.dimension] = points
        return points


@dataclass(frozen=True)
class Silences(Searches):
    """Turns numpy's warnings off for everyone."""

    def first(self, objective, start, rng):
        np.seterr(all="ignore")
        return start(10)


@dataclass(frozen=True)
class Threads(Searches):
    """Leaves a thread behind."""

    def first(self, objective, start, rng):
        threading.Thread(target=time.sleep, args=[20.0], daemon=True).start()
        return start(10)


@dataclass(frozen=True)
class Prints(Searches):
    """Tells its progress."""

    def first(self, objective, start, rng):
        print("generation 1")
        return start(10)


@dataclass
class Mutable(Searches):
    """Has settings that can be changed."""

    particles: int = 10


@dataclass(frozen=True)
class Swallows(Searches):
    """Catches whatever a model raises."""

    def search(self, objective, start, rng):
        while True:
            try:
                objective.many(rng.random((objective.dimension, 10)))
            except ArithmeticError:
                return


@dataclass(frozen=True)
class Exits(Searches):
    """Ends its process politely."""

    def first(self, objective, start, rng):
        sys.exit(0)


@dataclass(frozen=True)
class Hangs(Searches):
    """Never returns."""

    def first(self, objective, start, rng):
        while True:
            time.sleep(1.0)


@dataclass(frozen=True)
class HangsDeep(Searches):
    """Never returns from compiled code, where Python answers no signal."""

    def first(self, objective, start, rng):
        return sum(itertools.repeat(0))


class Undecorated(Searches):
    """Has a setting that nobody can set."""

    particles: int = 10


@dataclass(frozen=True)
class Demands(Searches):
    """Has a setting without a default."""

    particles: int

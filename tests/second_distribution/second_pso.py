"""Optimizers of a distribution that shares a name with ours and leaves things as no guest should."""

import sys
from dataclasses import dataclass

from hysteresis_bench.contracts import Optimizer

if "exit" in sys.argv:
    sys.exit(0)


@dataclass(frozen=True)
class Pso(Optimizer):
    """Not the one that you think."""

    def search(self, objective, start, rng):
        objective.many(start(5))


@dataclass(frozen=True)
class Leaves(Optimizer):
    """Ends the process that imports it, where it is told to."""

    def search(self, objective, start, rng):
        objective.many(start(5))

"""scipy's dual annealing: generalized simulated annealing with local descents.

[1] Y. Xiang, D. Y. Sun, W. Fan, X. G. Gong, Generalized simulated annealing algorithm and its application
    to the Thomson model, Physics Letters A 233 (1997) 216-220.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class ScipyDualAnnealing(Optimizer):
    """Generalized simulated annealing with local descents (dual annealing, scipy).

    initial_temperature, visit, accept : as scipy documents them

    Bounds: jumps are folded back into the box, by scipy; local descents are bounded. It anneals again by
    itself when it is cold, and goes on until the budget is spent.
    """

    initial_temperature: float = 5230.0
    visit: float = 2.62
    accept: float = -5.0

    def __post_init__(self) -> None:
        between(0.02, 5e4, initial_temperature=self.initial_temperature)
        between(1.01, 3, visit=self.visit)
        between(-9999, -5, accept=self.accept)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import dual_annealing

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, box, clipped

        dual_annealing(
            clipped(objective),
            box(objective),
            x0=start(1)[:, 0],
            initial_temp=self.initial_temperature,
            visit=self.visit,
            accept=self.accept,
            maxiter=UNLIMITED,
            maxfun=UNLIMITED,
            rng=rng,
        )

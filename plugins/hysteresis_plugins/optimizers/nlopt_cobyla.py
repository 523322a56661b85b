"""nlopt's COBYLA with restarts.

[1] M. J. D. Powell, A direct search optimization method that models the objective and constraint functions
    by linear interpolation, Advances in Optimization and Numerical Analysis (1994) 51-67.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class NloptCobyla(Optimizer):
    """Linear models in a trust region (COBYLA, nlopt), restarted from uniform random points.

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range

    Bounds: nlopt's version keeps its steps inside the box.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import local_searches

        local_searches("LN_COBYLA", objective, start, rng, self.tolerance)

"""nlopt's BOBYQA with restarts.

[1] M. J. D. Powell, The BOBYQA algorithm for bound constrained optimization without derivatives, report
    NA2009/06, University of Cambridge (2009).
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class NloptBobyqa(Optimizer):
    """Quadratic models in a trust region (BOBYQA, nlopt), restarted from uniform random points.

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range

    Bounds: the method's own, kept exactly.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import local_searches

        local_searches("LN_BOBYQA", objective, start, rng, self.tolerance)

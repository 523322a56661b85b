"""nlopt's Nelder-Mead simplex with restarts.

[1] J. A. Nelder, R. Mead, A simplex method for function minimization, Computer Journal 7 (1965) 308-313.
[2] M. J. Box, A new method of constrained optimization and a comparison with other methods, Computer
    Journal 8 (1965) 42-52: the rule for bounds.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class NloptNelderMead(Optimizer):
    """Downhill simplex (Nelder-Mead, nlopt), restarted from uniform random points.

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range

    Bounds: points outside are put on the wall, by nlopt.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import local_searches

        local_searches("LN_NELDERMEAD", objective, start, rng, self.tolerance)

"""nlopt's Subplex with restarts.

[1] T. H. Rowan, Functional stability analysis of numerical algorithms, thesis, University of Texas at
    Austin (1990).
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class NloptSubplex(Optimizer):
    """Downhill simplices in subspaces (Subplex, nlopt), restarted from uniform random points.

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range

    Bounds: points outside are put on the wall, by nlopt.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import local_searches

        local_searches("LN_SBPLX", objective, start, rng, self.tolerance)

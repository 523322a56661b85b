"""scipy's simplicial homology global optimization.

[1] S. C. Endres, C. Sandrock, W. W. Focke, A simplicial homology algorithm for Lipschitz optimisation,
    Journal of Global Optimization 72 (2018) 181-217.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least


@dataclass(frozen=True)
class ScipyShgo(Optimizer):
    """Local descents from the minima of a growing simplicial mesh (SHGO, scipy); deterministic.

    points : mesh points added between two rounds of descents

    Bounds: the mesh fills the box; local descents (SLSQP) are bounded. The shared first points do not
    enter. The mesh is refined until the budget is spent.
    Each round visits the whole mesh in Python: small rounds are slow.
    """

    points: int = 256

    def __post_init__(self) -> None:
        at_least(1, points=self.points)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import shgo

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, box, clipped

        shgo(clipped(objective), box(objective), n=self.points, iters=UNLIMITED)

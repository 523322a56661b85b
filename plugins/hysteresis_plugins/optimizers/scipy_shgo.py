"""scipy's simplicial homology global optimization.

[1] S. C. Endres, C. Sandrock, W. W. Focke, A simplicial homology algorithm for Lipschitz optimisation,
    Journal of Global Optimization 72 (2018) 181-217.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start


@dataclass(frozen=True)
class ScipyShgo(Optimizer):
    """Local descents from the minima of a growing simplicial mesh (SHGO, scipy); deterministic.

    Bounds: the mesh fills the box; local descents (SLSQP) are bounded. The shared first points do not
    enter. The mesh is refined until the budget is spent.
    """

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import shgo

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, box, clipped

        shgo(clipped(objective), box(objective), iters=UNLIMITED)

"""Accelerated random search.

[1] M. J. Appel, R. Labarre, D. Radulović, On accelerated random search, SIAM Journal on Optimization 14 (2003) 708-731.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start


@dataclass(frozen=True)
class Example(Optimizer):
    """Accelerated random search [1]: uniform points in a box around the best, which shrinks until one is better.

    particles : points evaluated at once
    contraction : by how much the box shrinks after points of which none is better, above 1
    precision : half width below which the box is the whole one again

    Bounds: points that would leave the unit box lie on its wall. Ours: [1] evaluates one point at a time.
    """

    particles: int = 20
    contraction: float = 2.0
    precision: float = 1e-4

    def __post_init__(self) -> None:
        if self.particles < 1:
            raise ValueError(f"particles = {self.particles} must be at least 1.")
        if not self.contraction > 1.0:
            raise ValueError(f"contraction = {self.contraction} must be above 1.")
        if not 0.0 < self.precision < 1.0:
            raise ValueError(f"precision = {self.precision} must lie between 0 and 1.")

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        points, best, lowest, width = start(self.particles), None, np.inf, 1.0
        while True:  # the meter ends it: an exception leaves through here when the budget is spent
            losses = objective.many(points)
            winner = int(np.argmin(losses))
            if best is None or losses[winner] < lowest:
                best, lowest, width = points[:, winner : winner + 1].copy(), losses[winner], 1.0  # [1] step 2
            else:
                width /= self.contraction  # [1] step 3
            if width < self.precision:
                width = 1.0
            step = width * (2.0 * rng.random(points.shape) - 1.0)
            points = np.clip(best + step, 0.0, 1.0)

    def evaluations_per_iteration(self, dimension: int) -> int:
        return self.particles

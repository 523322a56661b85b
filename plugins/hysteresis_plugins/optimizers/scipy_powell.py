"""scipy's Powell method with restarts.

[1] M. J. D. Powell, An efficient method for finding the minimum of a function of several variables without
    calculating derivatives, Computer Journal 7 (1964) 155-162.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class ScipyPowell(Optimizer):
    """Line searches along conjugate directions (Powell, scipy), restarted from uniform random points.

    tolerance : a descent ends when a round improves the loss by less than this share of it; also the
        relative precision of its line searches

    Bounds: the line searches end at the walls, by scipy.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import minimize

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, box, clipped

        options = {"xtol": self.tolerance, "ftol": self.tolerance, "maxiter": UNLIMITED, "maxfev": UNLIMITED}
        for points in first_points(objective, start, rng):
            minimize(clipped(objective), points[:, 0], method="Powell", bounds=box(objective), options=options)

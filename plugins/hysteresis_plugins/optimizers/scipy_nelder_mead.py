"""scipy's Nelder-Mead simplex with restarts.

[1] J. A. Nelder, R. Mead, A simplex method for function minimization, Computer Journal 7 (1965) 308-313.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class ScipyNelderMead(Optimizer):
    """Downhill simplex (Nelder-Mead, scipy), restarted from uniform random points.

    tolerance : a descent ends when its simplex is this small, as a share of a parameter's range

    Bounds: points outside are put on the wall, by scipy.
    Ours: the first simplex spans a fifth of the box, towards its middle; scipy's own spans a twentieth of
    each coordinate's value, which depends on where zero lies. No stop on differences of the loss, whose
    unit is the user's.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import minimize

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, box, clipped

        options = {"xatol": self.tolerance, "fatol": np.inf, "maxiter": UNLIMITED, "maxfev": UNLIMITED}
        for points in first_points(objective, start, rng):
            point = points[:, 0]
            simplex = np.vstack([point, point + np.diag(np.where(point < 0.5, 0.2, -0.2))])
            minimize(
                clipped(objective),
                point,
                method="Nelder-Mead",
                bounds=box(objective),
                options={**options, "initial_simplex": simplex},
            )

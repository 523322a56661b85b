"""scipy's trust-region least squares on the residual vector, with restarts.

[1] M. A. Branch, T. F. Coleman, Y. Li, A subspace, interior, and conjugate gradient method for large-scale
    bound-constrained minimization problems, SIAM Journal on Scientific Computing 21 (1999) 1-23.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class ScipyLeastSquares(Optimizer):
    """Trust-region least squares on the residuals (scipy), restarted from uniform random points.

    tolerance : a descent ends when the sum of squares or the point changes by less than this share

    Bounds: the method's own; its points stay strictly inside the box. Every simulation counts, those of
    the Jacobian's finite differences too.
    """

    tolerance: float = 1e-8

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import least_squares

        from hysteresis_plugins.optimizers._scipy import UNLIMITED

        for points in first_points(objective, start, rng):
            least_squares(
                objective.residuals,
                points[:, 0],
                bounds=(0.0, 1.0),
                method="trf",
                ftol=self.tolerance,
                xtol=self.tolerance,
                # as small as scipy allows, for it has the residual's unit; but with none at all, a gradient
                # of exactly 0 makes scipy propose NaN
                gtol=np.finfo(float).eps,
                max_nfev=UNLIMITED,
            )

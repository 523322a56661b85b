"""scipy's L-BFGS-B with restarts.

[1] R. H. Byrd, P. Lu, J. Nocedal, C. Zhu, A limited memory algorithm for bound constrained optimization,
    SIAM Journal on Scientific Computing 16 (1995) 1190-1208.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._restart import first_points
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class ScipyLBfgsB(Optimizer):
    """Quasi-Newton descent (L-BFGS-B, scipy), restarted from uniform random points.

    difference_step : step of the gradient's finite differences, as a share of a parameter's range

    Bounds: the method's own; a difference that would leave the box is taken backward.
    Every gradient costs as many evaluations as there are parameters, taken as one swarm.
    """

    difference_step: float = 1e-8

    def __post_init__(self) -> None:
        between(1e-14, 0.5, difference_step=self.difference_step)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import minimize

        from hysteresis_plugins.optimizers._scipy import descent, with_gradient

        function = with_gradient(objective, self.difference_step)
        for points in first_points(objective, start, rng):
            minimize(function, points[:, 0], **descent(objective))

"""scipy's DIRECT: dividing rectangles.

[1] D. R. Jones, C. D. Perttunen, B. E. Stuckman, Lipschitzian optimization without the Lipschitz constant,
    Journal of Optimization Theory and Applications 79 (1993) 157-181.
[2] J. M. Gablonsky, C. T. Kelley, A locally-biased form of the DIRECT algorithm, Journal of Global
    Optimization 21 (2001) 27-37.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class ScipyDirect(Optimizer):
    """Division of the box into rectangles (DIRECT, scipy); deterministic.

    locally_biased : the variant [2] that prefers rectangles near the best point
    balance : ε of [1], the smallest relative improvement that a rectangle must promise

    Bounds: it samples centres of rectangles inside the box. The shared first points do not enter, and a
    restart would repeat it: its stops on the size of a rectangle are off, so that it divides further until
    the budget is spent.
    """

    locally_biased: bool = True
    balance: float = 1e-4

    def __post_init__(self) -> None:
        between(0, 1, balance=self.balance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import direct

        from hysteresis_plugins.optimizers._scipy import box, clipped

        direct(
            clipped(objective),
            box(objective),
            eps=self.balance,
            locally_biased=self.locally_biased,
            # these two size its memory: above what the budget affords, so that the meter stops it
            maxfun=2 * objective.budget + 1000,
            maxiter=objective.budget + 1000,
            vol_tol=0.0,
            len_tol=0.0,
        )

"""scipy's basin hopping.

[1] D. J. Wales, J. P. K. Doye, Global optimization by basin-hopping and the lowest energy structures of
    Lennard-Jones clusters containing up to 110 atoms, Journal of Physical Chemistry A 101 (1997) 5111-5116.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least, between


@dataclass(frozen=True)
class ScipyBasinHopping(Optimizer):
    """Random hops between the minima that L-BFGS-B descends to (scipy).

    hop : largest hop of a coordinate, as a share of its range
    temperature : in the loss's unit; 0 takes no hop that ends higher, and needs no unit
    difference_step : step of the gradient's finite differences, as a share of a parameter's range

    Bounds: a hop that would leave the box ends on the wall; the descent keeps inside by itself. The hop
    does not adapt, and there are no restarts: the search goes on until the budget is spent.
    """

    hop: float = 0.25
    temperature: float = 0.0
    difference_step: float = 1e-8

    def __post_init__(self) -> None:
        between(1e-6, 1, hop=self.hop)
        at_least(0, temperature=self.temperature)
        between(1e-14, 0.5, difference_step=self.difference_step)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from scipy.optimize import basinhopping

        from hysteresis_plugins.optimizers._scipy import UNLIMITED, descent, with_gradient

        def hopped(point: Array) -> Array:
            return np.clip(point + rng.uniform(-self.hop, self.hop, point.shape), 0.0, 1.0)

        basinhopping(
            with_gradient(objective, self.difference_step),
            start(1)[:, 0],
            niter=UNLIMITED,
            T=self.temperature,
            minimizer_kwargs=descent(objective),
            take_step=hopped,
            rng=rng,
        )

"""What the nlopt wrappers share: set-up, seeding, and how a search ends.

nlopt's random generator is one for the whole process, so one search at a time in a process; each search
seeds it from its own generator.
"""

from __future__ import annotations

from weakref import proxy

import nlopt
import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Start
from hysteresis_plugins.optimizers._restart import first_points


class Search:
    """An nlopt search in the unit box without limits of its own; it seeds nlopt's generator.

    algorithm : nlopt's name, such as "GN_CRS2_LM"
    nlopt : nlopt's own object, for further settings
    """

    def __init__(self, algorithm: str, objective: Objective, rng: Generator) -> None:
        nlopt.srand(int(rng.integers(1, 2**31)))
        self.nlopt = nlopt.opt(getattr(nlopt, algorithm), objective.dimension)
        self.nlopt.set_lower_bounds(0.0)
        self.nlopt.set_upper_bounds(1.0)
        here = proxy(self)  # nlopt's object never frees a cycle that it is part of
        self.nlopt.set_min_objective(lambda point, gradient: here._loss(point))
        self._objective = objective
        self._raised: BaseException | None = None

    def run(self, point: Array) -> None:
        """Search from a point (dimension,) until nlopt ends. That it can make no more progress is an end.

        What the objective raises is raised here, after nlopt has stopped: raised through nlopt, it turns
        into a SystemError where a method (BOBYQA) finishes on the same evaluation.
        """
        try:
            self.nlopt.optimize(point)
        except (nlopt.RoundoffLimited, nlopt.ForcedStop):
            pass
        except RuntimeError as error:
            if not str(error).startswith("nlopt failure"):
                raise
        if self._raised is not None:
            raise self._raised

    def _loss(self, point: Array) -> float:
        if self._raised is None:
            try:
                return self._objective(np.minimum(np.maximum(point, 0.0), 1.0))
            except BaseException as raised:
                self._raised = raised
                self.nlopt.force_stop()
        return np.inf


def local_searches(algorithm: str, objective: Objective, start: Start, rng: Generator, tolerance: float) -> None:
    """A local method from the shared first point, then from uniform random ones.

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range
    """
    search = Search(algorithm, objective, rng)
    search.nlopt.set_xtol_abs(tolerance)
    for points in first_points(objective, start, rng):
        search.run(points[:, 0])

"""What the nlopt wrappers share: set-up, seeding, and how a search ends.

nlopt's random generator is one for the whole process, so one search at a time in a process; each search
seeds it from its own generator.
"""

from __future__ import annotations

import nlopt
import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from hysteresis_bench.contracts import Objective, Start
from hysteresis_plugins.optimizers._restart import first_points


def prepared(algorithm: str, objective: Objective, rng: Generator) -> nlopt.opt:
    """An nlopt search in the unit box, without limits of its own, its process-wide generator seeded.

    algorithm : nlopt's name, such as "GN_CRS2_LM"
    """
    nlopt.srand(int(rng.integers(1, 2**31)))
    search = nlopt.opt(getattr(nlopt, algorithm), objective.dimension)
    search.set_lower_bounds(0.0)
    search.set_upper_bounds(1.0)
    search.set_min_objective(lambda point, gradient: objective(np.minimum(np.maximum(point, 0.0), 1.0)))
    return search


def run(search: nlopt.opt, point: NDArray) -> None:
    """Search from a point (dimension,) until nlopt ends. That it can make no more progress is such an end."""
    try:
        search.optimize(point)
    except nlopt.RoundoffLimited:
        return
    except RuntimeError as error:
        if not str(error).startswith("nlopt failure"):
            raise


def local_searches(algorithm: str, objective: Objective, start: Start, rng: Generator, tolerance: float) -> None:
    """A local method from the shared first point, then from uniform random ones.

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range
    """
    search = prepared(algorithm, objective, rng)
    search.set_xtol_abs(tolerance)
    for points in first_points(objective, start, rng):
        run(search, points[:, 0])

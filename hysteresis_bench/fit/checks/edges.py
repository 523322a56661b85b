"""Does a fitted parameter lie at an edge of its box?"""

from __future__ import annotations

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.least_squares import at_bound
from hysteresis_bench.fit.objective import Problem


def edges_reached(problem: Problem, values: Array) -> Array:
    """Which parameters lie at an edge of their box, (dimension,) of bool; values : (dimension,), in units.

    A weight of a sum that is about 0 does not: that part of the sum is not there, or the data cannot see it.
    """
    space = problem.space
    upper = space.to_unit(values.reshape(-1, 1))[:, 0] > 0.5
    nearest = np.where(upper, [p.upper for p in space.parameters], [p.lower for p in space.parameters])
    weights = [*problem.system.model.linear, *problem.system.linear]
    absent = np.isin(space.names, weights) & (nearest == 0.0)
    reached: Array = at_bound(space, values) & ~absent
    return reached


def at_edges(parameters: pd.DataFrame) -> list[str]:
    """A sentence a parameter that does."""
    return [
        f"{row.name} lies at the edge of its box ({row.value:.4g}): the optimum may lie outside, and its standard "
        f"error means little."
        for row in parameters[parameters["at_bound"]].itertuples(index=False)
    ]

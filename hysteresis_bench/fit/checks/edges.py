"""Does a fitted parameter lie at an edge of its box?"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.identifiability.combinations import listed
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
    """A sentence on those that do, if any."""
    rows = parameters[parameters["at_bound"]]
    place = edges_told(dict(zip(rows["name"], rows["value"], strict=True)))
    theirs = "their standard errors mean" if len(rows) > 1 else "its standard error means"
    return [f"{place}: the optimum may lie outside, and {theirs} little."] if place else []


def edges_told(values: Mapping[str, float]) -> str:
    """A clause on parameters that do, by name, with their values; empty where there are none."""
    if not values:
        return ""
    verb, edges = ("lies", "edge of its box") if len(values) == 1 else ("lie", "edges of their boxes")
    return f"{listed([*values])} {verb} at the {edges} ({listed([f'{value:.4g}' for value in values.values()])})"

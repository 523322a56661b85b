"""Does a model's own equation say already what an effect adds beside it, as LuGre's friction has a viscous force?"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.checks.behaviour import PLACES
from hysteresis_bench.fit.objective import Problem

SAME = 1e-6
"""Share of what the effect adds that the model may leave out: rounding leaves 1e-13, the nearest effect that is
another more than 1e-2. Halved or doubled it tells the same."""


def is_redundant(problem: Problem, name: str) -> bool:
    """Is all that the effect of this name adds a weighted sum of what the model's linear parameters add?

    Asked at a few points of the box, over the scored samples; no effect is that has a parameter that is not linear.
    """
    parameters = problem.space.parameters
    own = [row for row, q in enumerate(parameters) if q.name.startswith(f"{name}.")]
    laws = [row for row in problem.linear if parameters[row].name in problem.system.model.linear]
    if not own or not laws or not {*own} <= {*problem.linear}:
        return False
    return all(_within(problem, own, laws, place) for place in PLACES)


def _within(problem: Problem, own: list[int], laws: list[int], place: float) -> bool:
    """The same with the parameters that are not linear at this place of the box."""
    base = np.full(problem.space.dimension, place)
    base[[*own, *laws]] = 0.0
    points = np.tile(base[:, np.newaxis], 1 + len(own) + len(laws))
    for column, row in enumerate([*own, *laws], start=1):
        points[row, column] = 1.0
    errors = problem.residuals(points)
    added: Array = errors[:, 1:] - errors[:, :1]
    effect, model = added[:, : len(own)], _scaled(added[:, len(own) :])
    left = effect - model @ np.linalg.lstsq(model, effect, rcond=None)[0]
    return bool(np.linalg.norm(left) < SAME * np.linalg.norm(effect))


def _scaled(columns: Array) -> Array:
    """Columns of length 1, those that are 0 as they are."""
    lengths = np.linalg.norm(columns, axis=0)
    return columns / np.where(lengths > 0.0, lengths, 1.0)

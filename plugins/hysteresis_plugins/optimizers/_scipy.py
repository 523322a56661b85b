"""What the scipy wrappers share: the box, a scalar objective that rounding cannot push out of it, a gradient."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective

UNLIMITED = 1_000_000_000
"""For the libraries' own limits: the meter is what stops a search."""


def box(objective: Objective) -> list[tuple[float, float]]:
    return [(0.0, 1.0)] * objective.dimension


def clipped(objective: Objective) -> Callable[[Array], float]:
    """The loss at a point, after points that lie outside by a rounding error are put on the wall."""
    return lambda point: objective(np.minimum(np.maximum(point, 0.0), 1.0))


def with_gradient(objective: Objective, step: float) -> Callable[[Array], tuple[float, Array]]:
    """The loss and its forward differences from one swarm of dimension + 1 evaluations.

    A difference that would leave the box is taken backward.
    """
    dimension = objective.dimension

    def loss_and_gradient(point: Array) -> tuple[float, Array]:
        point = np.minimum(np.maximum(point, 0.0), 1.0)
        moved = np.where(point + step <= 1.0, point + step, point - step)
        swarm = np.repeat(point[:, None], dimension + 1, axis=1)
        np.fill_diagonal(swarm[:, 1:], moved)
        losses = objective.many(swarm)
        return float(losses[0]), (losses[1:] - losses[0]) / (moved - point)

    return loss_and_gradient


def descent(objective: Objective) -> dict[str, Any]:
    """Arguments by which scipy's minimizers descend with L-BFGS-B on loss and gradient together.

    The stop on a small gradient is off: it would be in the loss's unit, which is the user's.
    """
    options = {"maxiter": UNLIMITED, "maxfun": UNLIMITED, "gtol": 0.0}
    return {"method": "L-BFGS-B", "jac": True, "bounds": box(objective), "options": options}

"""Least squares of a problem: points followed to their optimum, and many warm starts, or folds, at once.

All of it is `kernels.levenberg_marquardt`, whose chains are simulated as one swarm.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.kernels import levenberg_marquardt
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

CONVERGED = 1e-6
"""Relative fall of the sum of squares by which an iteration no longer counts."""

FOLLOWED, EXACT = 60, 1e-14
"""Iterations of a polish at most, and the relative fall of the RMSE by which it ends."""

OVERLOOKED = 1e-4
"""Share of its loss by which a search's optimum is worse than another one that it should have found."""

AT_BOUND = 1e-3
"""A parameter within this fraction of its (scaled) box from an edge is said to lie at its bound."""


def errors(problem: Problem, points: Array) -> Array:
    """Measured minus simulated, (scored samples of all records, swarm); points : (dimension, swarm), unit box."""
    residuals = problem.residuals(points)
    return np.negative(residuals, out=residuals)


def split(joined: Array, records: Sequence[Record]) -> list[Array]:
    """Cut what runs over all scored samples into records."""
    return np.split(joined, np.cumsum([record.measured.size for record in records])[:-1])


def polish(problem: Problem, values: Array) -> Array:
    """The nearest local least-squares optimum inside the box, never worse than the beginning.

    values and result : (dimension,) in units, or (dimension, points), every point followed by itself
    """
    starts = problem.space.to_unit(values.reshape(values.shape[0], -1))
    points, losses = levenberg_marquardt.descend(
        lambda points, _: problem.residuals(points),
        lambda points, _: problem.losses(points),
        np.clip(starts, 1e-9, 1.0 - 1e-9),
        iterations=FOLLOWED,
        converged=EXACT,
    )
    kept = problem.losses(np.clip(starts, 0.0, 1.0)) <= losses
    return np.where(kept, values.reshape(starts.shape), problem.space.from_unit(points)).reshape(values.shape)


def not_overlooked(problem: Problem, values: Array, searched: Callable[[Problem], Array]) -> Array:
    """The values that a search found, or what begins at the same model without its effects where that is better.

    A global search of many parameters may pass over an effect that is nearly off, or the frequency of a hum. So the
    effects begin switched off around the model that fits best without them, and at what they propose themselves.

    values and result : (dimension,) in units;  searched : the values (dimension,) that a search finds for a problem
    """
    own, middle = {q.name for q in problem.system.model.parameters}, values_of(problem, np.full(values.size, 0.5))
    off = {q.name: middle[q.name] if q.null is None else q.null for q in problem.space.parameters if q.name not in own}
    space = Space(tuple(q for q in problem.space.parameters if q.name in own))
    if not off or not space.parameters:
        return values
    bare = replace(problem, system=replace(problem.system, fixed={**problem.system.fixed, **off}), space=space)
    point = space.to_unit(searched(bare)[:, None])
    left, known = split(errors(bare, point)[:, 0], problem.records), {**off, **values_of(bare, point[:, 0])}
    proposed = [
        {f"{name}.{key}": value for key, value in proposal.items()}
        for name, effect in problem.system.effects
        for proposal in effect.starts(problem.records, left) or []
    ]
    starts = np.column_stack([point_of(problem, {**known, **others}) for others in ({}, *proposed)])
    points, squares = descend(problem, starts)
    best = int(np.argmin(squares))
    now = problem.losses(problem.space.to_unit(values[:, None]))[0]
    better = problem.losses(points[:, [best]])[0] < (1.0 - OVERLOOKED) * now
    return problem.space.from_unit(points[:, [best]])[:, 0] if better else values


def point_of(problem: Problem, values: Mapping[str, float]) -> Array:
    """(dimension,) in the unit box, from values in units by parameter's name; cut at the box."""
    column = np.array([[values[name]] for name in problem.space.names])
    low = np.array([[parameter.lower] for parameter in problem.space.parameters])
    high = np.array([[parameter.upper] for parameter in problem.space.parameters])
    return np.clip(problem.space.to_unit(np.clip(column, low, high)), 0.0, 1.0)[:, 0]


def at_bound(space: Space, values: Array) -> Array:
    """Which parameters lie at an edge of their box that is no limiting form, (dimension,) of bool.

    values : (dimension,), in units
    """
    point = space.to_unit(values.reshape(-1, 1))[:, 0]
    low = np.array([p.lower != p.limit for p in space.parameters], dtype=bool)
    high = np.array([p.upper != p.limit for p in space.parameters], dtype=bool)
    return low & (point < AT_BOUND) | high & (point > 1.0 - AT_BOUND)


def values_of(problem: Problem, point: Array) -> dict[str, float]:
    """Values in units by parameter's name."""
    values = problem.space.from_unit(point[:, None])[:, 0]
    return dict(zip(problem.space.names, map(float, values), strict=True))


def jacobian(problem: Problem, points: Array) -> tuple[Array, Array]:
    """Errors (samples, swarm) and their derivatives (samples, swarm, dimension) by the unit box's coordinates."""
    return levenberg_marquardt.jacobian(lambda swarm, _: errors(problem, swarm), points, np.arange(points.shape[1]))


def descend(
    problem: Problem, starts: Array, weights: Array | None = None, *, iterations: int = 30
) -> tuple[Array, Array]:
    """Follow every chain downhill -> its point (dimension, chains) and its sum of squares (chains,).

    starts : (dimension, chains) in the unit box
    weights : (scored samples, chains), 0 where a sample does not count for a chain
    """
    roots = None if weights is None else np.sqrt(weights)

    def residuals(points: Array, chains: Array) -> Array:
        found = problem.residuals(points)
        return found if roots is None else np.multiply(found, roots[:, chains], out=found)

    def squares(points: Array, chains: Array) -> Array:
        if roots is None:
            return np.fmin(problem.squares(points), problem.worst)
        found = residuals(points, chains)
        return np.asarray(np.einsum("ij,ij->j", found, found))

    return levenberg_marquardt.descend(residuals, squares, starts, iterations=iterations, converged=CONVERGED)

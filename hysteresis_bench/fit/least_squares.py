"""Least squares of a problem: the polish of one point, and many warm starts, or folds, at once.

The latter are chains in one swarm: Levenberg-Marquardt [1] in the unit box. An iteration is two swarms a record:
every chain's point and its forward differences, then every chain's step at three dampings, of which the best is
taken. Ours: a parameter at its bound whose descent leads outside is held there; steps are cut at the box.

[1] D. W. Marquardt, J. Soc. Ind. Appl. Math. 11 (1963) 431.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.objective import CEILING, Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

STEP = 1e-6
"""Forward difference, in the unit box."""

DAMPINGS = np.array([0.03, 1.0, 30.0])
"""Tried in every iteration, times the chain's own."""

HOPELESS = 1e8
"""A damping beyond which no step helps."""

CONVERGED = 1e-6
"""Relative fall of the sum of squares by which an iteration no longer counts."""

AT_BOUND = 1e-3
"""A parameter within this fraction of its (scaled) box from an edge is said to lie at its bound."""


def errors(problem: Problem, points: Array) -> Array:
    """Measured minus simulated, (scored samples of all records, swarm); points : (dimension, swarm), unit box."""
    values = np.ascontiguousarray(problem.space.from_unit(points))
    limit = CEILING * problem.scale
    parts = [
        record.measured[:, None] - problem.system.respond(record, values)[record.scored] for record in problem.records
    ]
    joined = np.concatenate(parts)
    if not np.all(np.isfinite(joined)):
        joined = np.nan_to_num(joined, nan=limit, posinf=limit, neginf=-limit)
    return np.clip(joined, -limit, limit, out=joined)


def split(joined: Array, records: Sequence[Record]) -> list[Array]:
    """Cut what runs over all scored samples into records."""
    return np.split(joined, np.cumsum([record.measured.size for record in records])[:-1])


def polish(problem: Problem, values: Array) -> Array:
    """The nearest local least-squares optimum inside the box; values and result (dimension,), in units.

    Trust-region reflective (scipy) in the unit box; never worse than where it began.
    """
    from scipy.optimize import least_squares

    inside = np.clip(problem.space.to_unit(values.reshape(-1, 1))[:, 0], 1e-9, 1.0 - 1e-9)
    scale = problem.scale  # residuals of order one: the tolerances are then relative

    def residuals(point: Array) -> Array:
        return problem.residuals(np.clip(point, 0.0, 1.0)) / scale

    found = least_squares(residuals, inside, bounds=(0.0, 1.0), x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-12)
    candidates = [np.clip(found.x, 0.0, 1.0)[:, None], problem.space.to_unit(values.reshape(-1, 1))]
    losses = problem.losses(np.clip(np.hstack(candidates), 0.0, 1.0))
    best = candidates[0] if losses[0] < losses[1] else candidates[1]
    return problem.space.from_unit(best)[:, 0]


def point_of(problem: Problem, values: Mapping[str, float]) -> Array:
    """(dimension,) in the unit box, from values in units by parameter's name; cut at the box."""
    column = np.array([[values[name]] for name in problem.space.names])
    low = np.array([[parameter.lower] for parameter in problem.space.parameters])
    high = np.array([[parameter.upper] for parameter in problem.space.parameters])
    return np.clip(problem.space.to_unit(np.clip(column, low, high)), 0.0, 1.0)[:, 0]


def at_bound(space: Space, values: Array) -> Array:
    """Which parameters lie at an edge of their box, (dimension,) of bool; values : (dimension,), in units."""
    point = space.to_unit(values.reshape(-1, 1))[:, 0]
    return (point < AT_BOUND) | (point > 1.0 - AT_BOUND)


def values_of(problem: Problem, point: Array) -> dict[str, float]:
    """Values in units by parameter's name."""
    values = problem.space.from_unit(point[:, None])[:, 0]
    return dict(zip(problem.space.names, map(float, values), strict=True))


def jacobian(problem: Problem, points: Array) -> tuple[Array, Array]:
    """Errors (samples, swarm) and their derivatives (samples, swarm, dimension) by the unit box's coordinates."""
    dimension, chains = points.shape
    steps = np.where(points > 0.5, -STEP, STEP)
    moved = np.repeat(points[:, :, None], dimension + 1, axis=2)
    for row in range(dimension):
        moved[row, :, row + 1] += steps[row]
    swarm = errors(problem, moved.reshape(dimension, -1)).reshape(-1, chains, dimension + 1)
    return swarm[:, :, 0], (swarm[:, :, 1:] - swarm[:, :, :1]) / steps.T


def descend(
    problem: Problem, starts: Array, weights: Array | None = None, *, iterations: int = 30
) -> tuple[Array, Array]:
    """Follow every chain downhill -> its point (dimension, chains) and its sum of squares (chains,).

    starts : (dimension, chains) in the unit box
    weights : (scored samples, chains), 0 where a sample does not count for a chain
    """
    points = np.clip(starts, 0.0, 1.0)
    dimension, chains = points.shape
    squares = _squares(errors(problem, points), weights)
    damping = np.full(chains, 1e-3)
    active = np.arange(chains) if dimension else np.arange(0)
    for _ in range(iterations):
        if not active.size:
            break
        own = None if weights is None else weights[:, active]
        steps = _steps(*_normal(problem, points[:, active], own), points[:, active], damping[active])
        tried = np.clip(points[:, active, None] + steps, 0.0, 1.0)
        tripled = None if own is None else np.repeat(own, DAMPINGS.size, axis=1)
        found = _squares(errors(problem, tried.reshape(dimension, -1)), tripled).reshape(-1, DAMPINGS.size)
        best = np.argmin(found, axis=1)
        rows = np.arange(active.size)
        least, before = found[rows, best], squares[active]
        better = least < before
        damping[active] *= np.where(better, 0.3 * DAMPINGS[best], 1e3)
        damping[active] = np.maximum(damping[active], 1e-12)
        moved = active[better]
        points[:, moved], squares[moved] = tried[:, rows[better], best[better]], least[better]
        stalled = better & (before - least <= CONVERGED * before)
        active = active[~stalled & (damping[active] < HOPELESS)]
    return points, squares


def _squares(residuals: Array, weights: Array | None) -> Array:
    if weights is None:
        squares: Array = np.einsum("ij,ij->j", residuals, residuals)
    else:
        squares = np.einsum("ij,ij,ij->j", residuals, residuals, weights)
    return squares


def _normal(problem: Problem, points: Array, weights: Array | None) -> tuple[Array, Array]:
    """Normal matrices (chains, d, d) and descents (chains, d)."""
    residuals, slopes = jacobian(problem, points)
    matrices, descents = [], []
    for chain in range(points.shape[1]):
        columns = np.ascontiguousarray(slopes[:, chain])
        weighted = columns if weights is None else columns * weights[:, chain, None]
        matrices.append(weighted.T @ columns)
        descents.append(-(weighted.T @ residuals[:, chain]))
    return np.array(matrices), np.array(descents)


def _steps(matrices: Array, descents: Array, points: Array, damping: Array) -> Array:
    """(dimension, chains, dampings)"""
    held = ((points <= 0.0) & (descents.T < 0.0) | (points >= 1.0) & (descents.T > 0.0)).T
    diagonal = np.einsum("ijj->ij", matrices)
    largest = np.max(diagonal, axis=1, keepdims=True)
    held |= largest <= 0.0
    # a held parameter's row and column say that its step is 0
    inner = np.where(held[:, :, None] | held[:, None, :], 0.0, matrices)
    floor = np.maximum(diagonal, 1e-12 * largest)
    added = damping[:, None, None] * DAMPINGS[:, None] * floor[:, None, :] + 1e-14 * largest[:, :, None]
    added = np.where(held[:, None, :], 1.0, added)
    systems = inner[:, None] + added[..., None] * np.eye(points.shape[0])
    right = np.where(held, 0.0, descents)[:, None, :, None]
    return np.linalg.solve(systems, np.broadcast_to(right, (*systems.shape[:3], 1)))[..., 0].transpose(2, 0, 1)

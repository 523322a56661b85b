"""Levenberg-Marquardt [1] of many chains at once, in the unit box.

An iteration is two swarms: every chain's point and its forward differences, then every chain's step at several
dampings, of which the best is taken. A step is the least of its damped quadratic problem inside the box (ours: the
cited method knows no bounds), so that parameters that are linear arrive at once, many bounds or none.

[1] D. W. Marquardt, J. Soc. Ind. Appl. Math. 11 (1963) 431.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bounded_steps import bounded_steps
from hysteresis_bench.kernels.squares import differences_into

STEP = 1e-6
"""Forward difference, in the unit box."""

DAMPINGS = np.array([0.03, 1.0, 30.0])
"""Tried in every iteration, times the chain's own."""

FIRST, LEAST, HOPELESS = 1e-3, 1e-12, 1e8
"""A chain's own damping: where it begins, where it stays, and beyond which no step helps."""

COLUMNS = 64
"""Of simulated output held at once."""

Residuals = Callable[[Array, Array], Array]
"""residuals(points (dimension, swarm), chains (swarm,)) -> (samples, swarm), finite; chains : whose points they are."""
Merit = Callable[[Array, Array], Array]
"""merit(points, chains) -> (swarm,): the sum of the residuals' squares, or whatever rises with it."""


def jacobian(residuals: Residuals, points: Array, chains: Array) -> tuple[Array, Array]:
    """Residuals (samples, swarm) and their derivatives (samples, swarm, dimension) by the unit box's coordinates."""
    left, differences, steps = _differences(residuals, points, chains)
    return left.T, differences.transpose(1, 0, 2) / steps.T


def _differences(residuals: Residuals, points: Array, chains: Array) -> tuple[Array, Array, Array]:
    """Residuals (swarm, samples), their forward differences (swarm, samples, dimension), steps (dimension, swarm)."""
    dimension, swarm = points.shape
    steps = np.where(points > 0.5, -STEP, STEP)
    moved = np.repeat(points[:, :, None], dimension + 1, axis=2)
    for row in range(dimension):
        moved[row, :, row + 1] += steps[row]
    found = residuals(moved.reshape(dimension, -1), np.repeat(chains, dimension + 1))
    found = found.reshape(-1, swarm, dimension + 1)
    left = np.empty((swarm, found.shape[0]))
    differences = np.empty((*left.shape, dimension))
    differences_into(left, differences, found)
    return left, differences, steps


def descend(
    residuals: Residuals, merit: Merit, starts: Array, *, iterations: int, converged: float
) -> tuple[Array, Array]:
    """Follow every chain downhill -> its point (dimension, chains) and its merit (chains,).

    starts : (dimension, chains) in the unit box
    converged : a chain ends where an iteration lowers its merit by less than this share
    """
    points = np.clip(starts, 0.0, 1.0)
    dimension, chains = points.shape
    active = np.arange(chains)
    merits = merit(points, active)
    damping = np.full(chains, FIRST)
    for _ in range(iterations if dimension else 0):
        if not active.size:
            break
        steps = _steps(*_normal(residuals, points[:, active], active), points[:, active], damping[active])
        tried = np.clip(points[:, active, None] + steps, 0.0, 1.0)
        found = merit(tried.reshape(dimension, -1), np.repeat(active, DAMPINGS.size)).reshape(-1, DAMPINGS.size)
        best = np.argmin(found, axis=1)
        rows = np.arange(active.size)
        least, before = found[rows, best], merits[active]
        better = least < before
        damping[active] = np.maximum(damping[active] * np.where(better, 0.3 * DAMPINGS[best], 1e3), LEAST)
        moved = active[better]
        points[:, moved], merits[moved] = tried[:, rows[better], best[better]], least[better]
        stalled = better & (before - least <= converged * before)
        active = active[~stalled & (damping[active] < HOPELESS)]
    return points, merits


def _normal(residuals: Residuals, points: Array, chains: Array) -> tuple[Array, Array]:
    """Normal matrices (chains, d, d) and descents (chains, d)."""
    matrices, descents = [], []
    for group in _groups(chains.size, max(1, COLUMNS // (points.shape[0] + 1))):
        left, differences, steps = _differences(residuals, points[:, group], chains[group])
        columns = differences.transpose(0, 2, 1)
        matrices.append(columns @ differences / (steps.T[:, :, None] * steps.T[:, None, :]))
        descents.append(-(columns @ left[..., None])[..., 0] / steps.T)
    return np.concatenate(matrices), np.concatenate(descents)


def _groups(count: int, size: int) -> Iterator[slice]:
    return (slice(first, first + size) for first in range(0, count, size))


def _steps(matrices: Array, descents: Array, points: Array, damping: Array) -> Array:
    """(dimension, chains, dampings)"""
    dimension, chains = points.shape
    diagonal = np.einsum("ijj->ij", matrices)
    largest = np.max(diagonal, axis=1, keepdims=True)
    largest = np.where(largest > 0.0, largest, 1.0)
    floor = np.maximum(diagonal, 1e-12 * largest)
    added = damping[:, None, None] * DAMPINGS[:, None] * floor[:, None, :] + 1e-14 * largest[:, :, None]
    systems = (matrices[:, None] + added[..., None] * np.eye(dimension)).reshape(-1, dimension, dimension)
    right, low, high = (np.repeat(one, DAMPINGS.size, axis=0) for one in (descents, -points.T, 1.0 - points.T))
    found = bounded_steps(systems, right, low, high)
    return found.reshape(chains, DAMPINGS.size, dimension).transpose(2, 0, 1)

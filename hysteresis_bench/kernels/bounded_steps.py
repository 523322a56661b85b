"""Many small quadratic problems with bounds at once: the steps of a bounded least-squares descent.

Block principal pivoting [1]: every coordinate is free, or at one of its bounds; all that contradict the optimality
conditions change sides at once, and where that no longer helps, only the last of them, which cannot cycle [2].

[1] J. J. Júdice, F. M. Pires, A block principal pivoting algorithm for large-scale strictly monotone linear
    complementarity problems, Computers and Operations Research 21 (1994) 587.
[2] K. G. Murty, Note on a Bard-type scheme for solving the complementarity problem, Opsearch 11 (1974) 123.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array

PATIENCE = 3
"""Exchanges of whole blocks without progress before single ones follow, as in [1]."""
EXCHANGES = 100
"""At most so many for each coordinate; rounding may keep a coordinate of no slope between its sides for ever."""


def bounded_steps(matrices: Array, descents: Array, low: Array, high: Array) -> Array:
    """Steps s (problems, d) that minimize s A s / 2 - b s with low <= s <= high.

    matrices : A, (problems, d, d), symmetric and positive definite;  descents : b, (problems, d)
    low, high : (problems, d), low <= 0 <= high
    """
    steps = np.linalg.solve(matrices, descents[..., None])[..., 0]
    out = np.flatnonzero(((steps < low) | (steps > high)).any(axis=1))  # most steps meet no bound, and are done
    if out.size:
        steps[out] = _pivoted(matrices[out], descents[out], low[out], high[out])
    return np.clip(steps, low, high)


def _pivoted(matrices: Array, descents: Array, low: Array, high: Array) -> Array:
    """As `bounded_steps`, by exchanging sides; but for rounding within the bounds."""
    problems, dimension = descents.shape
    at_low, at_high = np.zeros((2, problems, dimension), dtype=bool)
    fewest, patience = np.full(problems, dimension + 1), np.full(problems, PATIENCE)
    steps = np.zeros((problems, dimension))
    open_ = np.arange(problems) if dimension else np.arange(0)
    for _ in range(EXCHANGES * dimension):
        lower, upper = at_low[open_], at_high[open_]
        part, slopes = _with_sides(matrices[open_], descents[open_], low[open_], high[open_], lower, upper)
        steps[open_] = part
        free = ~(lower | upper)
        below, above = free & (part < low[open_]), free & (part > high[open_])
        released = lower & (slopes > 0.0) | upper & (slopes < 0.0)
        wrong = below | above | released
        count = wrong.sum(axis=1)
        fell = count < fewest[open_]
        fewest[open_] = np.minimum(fewest[open_], count)
        patience[open_] = np.where(fell, PATIENCE, patience[open_] - 1)
        single = patience[open_] < 0
        last = dimension - 1 - np.argmax(wrong[:, ::-1], axis=1)
        wrong &= ~single[:, None] | (np.arange(dimension) == last[:, None])
        at_low[open_] = np.where(wrong, below, lower)
        at_high[open_] = np.where(wrong, above, upper)
        open_ = open_[count > 0]
        if not open_.size:
            break
    return steps


def _with_sides(
    matrices: Array, descents: Array, low: Array, high: Array, at_low: Array, at_high: Array
) -> tuple[Array, Array]:
    """The steps with some coordinates at their bounds, and the descents b - A s that are left there."""
    held = at_low | at_high
    bounds = np.where(at_low, low, np.where(at_high, high, 0.0))
    right = np.where(held, bounds, descents - np.einsum("nij,nj->ni", matrices, bounds))
    inner = np.where(held[:, :, None] | held[:, None, :], 0.0, matrices)
    inner[:, np.arange(held.shape[1]), np.arange(held.shape[1])] += held
    steps = np.linalg.solve(inner, right[..., None])[..., 0]
    return steps, np.where(held, descents - np.einsum("nij,nj->ni", matrices, steps), 0.0)

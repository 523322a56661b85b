"""Parameters in which the residuals are affine, eliminated: for each point, the values that leave least [1].

Bounds are kept: the least squares of these parameters is a quadratic problem in their part of the unit box.

[1] G. H. Golub, V. Pereyra, The differentiation of pseudo-inverses and nonlinear least squares problems whose
    variables separate, SIAM Journal on Numerical Analysis 10 (1973) 413.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bounded_steps import bounded_steps

COLUMNS = 64
"""Of residuals held at once."""


def eliminate(residuals: Callable[[Array], Array], points: Array, linear: Sequence[int]) -> tuple[Array, Array]:
    """The points with the best values of their linear coordinates, and the sums of squares that these leave.

    residuals : (dimension, swarm) -> (samples, swarm);  points : (dimension, swarm) in the unit box
    linear : rows in which the residuals are jointly affine; len(linear) + 1 simulations a point
    """
    rows, each = list(linear), len(linear) + 1
    found, squares = points.copy(), np.empty(points.shape[1])
    size = max(1, COLUMNS // each)
    for first in range(0, points.shape[1], size):
        group = slice(first, first + size)
        asked = np.repeat(points[:, group, None], each, axis=2)
        asked[rows] = 0.0
        asked[rows, :, range(1, each)] = 1.0
        answers = residuals(asked.reshape(points.shape[0], -1))
        answers = answers.reshape(answers.shape[0], -1, each)
        found[rows, group], squares[group] = _least(answers[:, :, 0], answers[:, :, 1:] - answers[:, :, :1])
    return found, squares


def _least(left: Array, slopes: Array) -> tuple[Array, Array]:
    """Coordinates (linear, points) and sums of squares (points,); left : (samples, points), slopes : with linear."""
    columns = np.ascontiguousarray(slopes.transpose(1, 0, 2))
    matrices = columns.transpose(0, 2, 1) @ columns
    descents = -np.einsum("psl,sp->pl", columns, left)
    diagonal = np.einsum("pll->pl", matrices)
    diagonal += 1e-14 * np.maximum(diagonal.max(axis=1, keepdims=True), np.finfo(float).tiny)
    shares = bounded_steps(matrices, descents, np.zeros_like(descents), np.ones_like(descents))
    rest = left + np.einsum("psl,pl->sp", columns, shares)
    return shares.T, np.einsum("sp,sp->p", rest, rest)

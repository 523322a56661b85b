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
from hysteresis_bench.kernels.squares import differences_into

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
        left = np.empty((answers.shape[1], answers.shape[0]))
        slopes = np.empty((*left.shape, len(rows)))
        differences_into(left, slopes, answers)
        found[rows, group], squares[group] = _least(left, slopes)
    return found, squares


def _least(left: Array, slopes: Array) -> tuple[Array, Array]:
    """Coordinates (linear, points) and sums of squares (points,); left : (points, samples), slopes : with linear."""
    matrices = slopes.transpose(0, 2, 1) @ slopes
    descents = -(slopes.transpose(0, 2, 1) @ left[:, :, None])[:, :, 0]
    diagonal = np.einsum("pll->pl", matrices)
    diagonal += 1e-14 * np.maximum(diagonal.max(axis=1, keepdims=True), np.finfo(float).tiny)
    shares = bounded_steps(matrices, descents, np.zeros_like(descents), np.ones_like(descents))
    left += (slopes @ shares[:, :, None])[:, :, 0]
    return shares.T, np.einsum("ps,ps->p", left, left)

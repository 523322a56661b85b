"""Bounded quadratic problems against scipy's, and by the conditions of optimality."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from hysteresis_bench.kernels.bounded_steps import bounded_steps


@pytest.mark.parametrize("dimension", [1, 2, 5, 12, 30])
def test_steps_are_those_of_bounded_least_squares(dimension):
    rng = np.random.default_rng(dimension)
    slopes = rng.standard_normal((20, 60, dimension)) + 2.0 * rng.standard_normal((20, 60, 1))
    errors = 3.0 * rng.standard_normal((20, 60))
    low, high = -0.1 * rng.random((20, dimension)), 0.1 * rng.random((20, dimension))
    found = bounded_steps(
        slopes.transpose(0, 2, 1) @ slopes, np.einsum("nsi,ns->ni", slopes, errors), low=low, high=high
    )
    for problem in range(20):
        bounds = (low[problem], high[problem])
        expected = lsq_linear(slopes[problem], errors[problem], bounds=bounds, method="bvls", tol=1e-14).x
        assert found[problem] == pytest.approx(expected, abs=1e-9)


def test_nearly_dependent_columns_keep_the_conditions_of_optimality():
    """As plays of neighbouring thresholds are."""
    rng = np.random.default_rng(3)
    base = rng.standard_normal((200, 1))
    slopes = base + 1e-5 * rng.standard_normal((200, 15))
    matrix, descent = slopes.T @ slopes + 1e-12 * np.eye(15), slopes.T @ rng.standard_normal(200)
    steps = bounded_steps(matrix[None], descent[None], np.zeros((1, 15)), np.ones((1, 15)))[0]
    left = descent - matrix @ steps
    free = (steps > 0.0) & (steps < 1.0)
    scale = np.abs(descent).max()
    assert np.all(np.abs(left[free]) < 1e-6 * scale)
    assert np.all(left[steps == 0.0] < 1e-6 * scale)
    assert np.all(left[steps == 1.0] > -1e-6 * scale)


def test_a_coordinate_without_room_stays():
    steps = bounded_steps(np.eye(2)[None], np.array([[5.0, -5.0]]), np.zeros((1, 2)), np.array([[0.0, 1.0]]))
    assert np.array_equal(steps, [[0.0, 0.0]])

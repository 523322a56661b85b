"""Linear coordinates are eliminated: what is left is the least over them, for every point."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from hysteresis_bench.kernels.variable_projection import eliminate

TIME = np.linspace(0.0, 1.0, 90)
MEASURED = 0.8 * np.exp(-3.0 * TIME) - 0.4 * np.exp(-9.0 * TIME) + 0.05 * np.sin(40.0 * TIME)


def residuals(points: np.ndarray) -> np.ndarray:
    """Two exponentials: amplitudes from -1 to 1 are linear, rates from 0 to 20 are not."""
    first, second, slow, fast = points
    swarm = (2.0 * first - 1.0) * np.exp(-20.0 * slow * TIME[:, None])
    return swarm + (2.0 * second - 1.0) * np.exp(-20.0 * fast * TIME[:, None]) - MEASURED[:, None]


def test_every_point_gets_its_best_amplitudes():
    points = np.random.default_rng(0).random((4, 60))
    found, squares = eliminate(residuals, points, (0, 1))
    assert np.array_equal(found[2:], points[2:])
    assert squares == pytest.approx(np.sum(residuals(found) ** 2, axis=0), rel=1e-8)
    for point, least in zip(points.T, squares, strict=True):
        columns = np.exp(-20.0 * point[2:] * TIME[:, None])
        assert least == pytest.approx(2.0 * lsq_linear(columns, MEASURED, bounds=(-1.0, 1.0), tol=1e-14).cost, rel=1e-6)


def test_all_coordinates_may_be_linear():
    columns = np.random.default_rng(1).standard_normal((50, 3))
    truth = np.array([0.2, 0.9, 0.4])
    found, squares = eliminate(lambda points: columns @ (points - truth[:, None]), np.full((3, 1), 0.5), (0, 1, 2))
    assert found[:, 0] == pytest.approx(truth, abs=1e-9)
    assert squares[0] == pytest.approx(0.0, abs=1e-15)


def test_the_points_asked_are_left_alone():
    points = np.random.default_rng(2).random((4, 3))
    before = points.copy()
    eliminate(residuals, points, (0, 1))
    assert np.array_equal(points, before)

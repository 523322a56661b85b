"""Non-negative least squares by block principal pivoting, against Lawson's and Hanson's."""

import numpy as np
import pytest
from scipy.optimize import nnls

from hysteresis_bench.fit.smooth.pivoting import least_above


@pytest.mark.parametrize("seed", range(8))
def test_it_finds_the_least_that_lawson_and_hanson_find(seed):
    rng = np.random.default_rng(seed)
    columns, target = rng.normal(size=(60, 25)) @ np.diag(10.0 ** rng.uniform(-2, 2, 25)), rng.normal(size=60)
    found = least_above(columns.T @ columns, columns.T @ target, np.zeros(25, dtype=bool), rng.random(25) < 0.5)
    np.testing.assert_allclose(found, nnls(columns, target)[0], rtol=1e-6, atol=1e-9)


def test_what_is_free_takes_either_sign():
    rng = np.random.default_rng(9)
    columns, target = rng.normal(size=(60, 6)), rng.normal(size=60)
    free = np.array([True, False, True, False, False, True])
    found = least_above(columns.T @ columns, columns.T @ target, free, np.zeros(6, dtype=bool))
    twice = nnls(np.concatenate([columns, -columns[:, free]], axis=1), target)[0]
    expected = twice[:6]
    expected[free] -= twice[6:]
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-12)
    assert found[free].min() < 0.0 <= found[~free].min()


def test_few_of_many_alike_unknowns_are_found():
    rng = np.random.default_rng(3)
    ramps = np.clip(np.linspace(0.0, 1.0, 300)[:, None] * 90.0 - np.arange(90), 0.0, 1.0)
    target = 0.4 * ramps[:, 7] + ramps[:, 8] + 0.1 * rng.normal(size=300)
    matrix = ramps.T @ ramps + 1e-8 * np.eye(90)
    found = least_above(matrix, ramps.T @ target, np.zeros(90, dtype=bool), np.ones(90, dtype=bool))
    slope = matrix @ found - ramps.T @ target
    assert found.min() == 0.0
    assert np.abs(slope[found > 0.0]).max() < 1e-9 < 1e-6 < slope[found == 0.0].max()
    assert slope.min() > -1e-9

import numpy as np
import pytest
from scipy.interpolate import BSpline

from hysteresis_bench.kernels.cubic_spline import cubic_spline


@pytest.mark.parametrize("intervals", [1, 2, 14])
def test_columns_are_the_powers_and_scipys_splines(intervals):
    knots = np.concatenate([[-1.0] * 3, np.linspace(-1.0, 1.0, intervals + 1), [1.0] * 3])
    x = np.concatenate([np.random.default_rng(0).uniform(-1.0, 1.0, 200), knots, [-1.0, 1.0, 0.0]])
    found = cubic_spline(x, knots)
    assert found[:, :3] == pytest.approx(x[:, None] ** (1, 2, 3), rel=1e-15)
    assert found[:, 3:] == pytest.approx(BSpline.design_matrix(x, knots, 3).toarray(), abs=1e-14)
    assert found[:, 3:].sum(axis=1) == pytest.approx(np.ones(x.size), abs=1e-14)

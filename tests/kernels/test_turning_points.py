"""The compiled turning points against a plain-Python twin."""

import numpy as np
import pytest

from hysteresis_bench.kernels.turning_points import turning_points


def twin(u, resolution):
    turns, high, low, heading = [], 0, 0, 0
    for i, value in enumerate(u):
        if heading >= 0 and value > u[high]:
            high = i
        if heading <= 0 and value < u[low]:
            low = i
        if heading >= 0 and u[high] - value > resolution:
            if heading > 0:
                turns.append(high)
            heading, low = -1, i
        elif heading <= 0 and value - u[low] > resolution:
            if heading < 0:
                turns.append(low)
            heading, high = 1, i
    return turns


@pytest.mark.parametrize("resolution", [0.0, 0.3, 2.0, 1e9])
@pytest.mark.parametrize("samples", [1, 2, 500])
def test_compiled_equals_a_plain_twin(samples, resolution):
    rng = np.random.default_rng(3)
    for u in (np.cumsum(rng.normal(size=samples)), np.round(rng.normal(size=samples), 1), np.ones(samples)):
        found = turning_points(u, resolution)
        assert found.dtype == np.int64
        assert found.tolist() == twin(u.tolist(), resolution)


def test_a_noisy_triangle_turns_at_its_tips():
    u = np.abs(np.arange(400) % 200 - 100.0)
    noisy = u + 0.4 * np.random.default_rng(4).standard_normal(400)
    assert np.abs(turning_points(noisy, 10.0) - [100, 200, 300]).max() <= 2

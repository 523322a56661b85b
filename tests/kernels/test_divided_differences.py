import numpy as np
import pytest

from hysteresis_bench.kernels.divided_differences import divided_differences


def plain(time, values, order, lag):
    """The same, window by window."""
    found = []
    for first in range(values.size - order * lag):
        t, v = (part[first : first + order * lag + 1 : lag] for part in (time, values))
        weights = np.array([1.0 / np.prod(np.delete(t[j] - t, j)) for j in range(order + 1)])
        found.append(weights @ v / np.linalg.norm(weights))
    return np.array(found)


@pytest.mark.parametrize(("order", "lag"), [(1, 1), (2, 1), (5, 2), (12, 1), (12, 4)])
@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_it_equals_the_plain_formula(order, lag, scale):
    rng = np.random.default_rng(order)
    time = np.cumsum(rng.uniform(0.5, 2.0, 80))
    values = rng.standard_normal(80)
    found = divided_differences(scale * time, values, order, lag)
    assert found == pytest.approx(plain(time, values, order, lag), rel=1e-9, abs=1e-11)


def test_a_polynomial_of_a_lower_degree_vanishes_and_white_noise_keeps_its_size():
    time = np.sort(np.random.default_rng(0).uniform(0.0, 1.0, 4000))
    assert np.abs(divided_differences(time[::40], 3.0 + time[::40] - 5.0 * time[::40] ** 3, 4, 1)).max() < 1e-12
    noise = np.random.default_rng(1).standard_normal(4000)
    assert np.sqrt(np.mean(divided_differences(time, noise, 4, 2) ** 2)) == pytest.approx(1.0, abs=0.05)


def test_too_few_samples_give_none():
    assert divided_differences(np.arange(3.0), np.ones(3), 3, 1).size == 0

"""A lag with a time constant of its own at every level, against a tight ODE solution and the first-order lag."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hysteresis_bench.kernels.lag import lag
from hysteresis_bench.kernels.lag_with_level import lag_with_level

LEVELS = np.linspace(-1.0, 2.0, 5)
CURVES = {
    "slower far out": (0.3, 0.15, 0.05, 0.15, 0.3),
    "slower above": (0.02, 0.05, 0.1, 0.2, 0.4),
    "sixteen times as slow next to the middle": (0.02, 0.02, 0.02, 0.32, 0.32),
}


def solved(time, u, constants):
    def slope(t, v):
        return (np.interp(t, time, u) - v) / np.interp(v, LEVELS, constants)

    parts = [np.array([u[0]])]
    for ends in pairwise(time):  # the input bends at every sample
        found = solve_ivp(slope, ends, parts[-1], rtol=1e-11, atol=1e-12, method="LSODA")
        parts.append(found.y[:, -1])
    return np.concatenate(parts)


def followed(time, u, constants):
    ends = np.array([LEVELS[0]]), np.array([LEVELS[-1]])
    return lag_with_level(time, u[:, None], *ends, np.array(constants)[:, None])[:, 0]


def wave(samples, uneven=False):
    time = np.linspace(0.0, 2.0, samples)
    if uneven:
        time = time + 0.3 / samples * np.sin(7.0 * np.arange(samples))
    return time, 0.5 + 1.4 * np.sin(2.0 * np.pi * time) + 0.4 * np.sin(5.0 * np.pi * time)


@pytest.mark.parametrize("constants", CURVES.values(), ids=CURVES.keys())
@pytest.mark.parametrize("uneven", [False, True])
def test_agrees_with_a_tight_ode_solution(constants, uneven):
    time, u = wave(400, uneven)
    found = followed(time, u, constants)
    np.testing.assert_allclose(found, solved(time, u, constants), rtol=0, atol=1e-3)
    assert u.min() <= found.min()
    assert found.max() <= u.max()


@pytest.mark.parametrize("tau", [1e-9, 0.004, 0.08, 1.5, 1e6])
def test_one_time_constant_is_the_first_order_lag(tau):
    for time, u in (wave(300), wave(300, uneven=True)):
        expected = lag(time, u[:, None], np.array([tau]))[:, 0]
        np.testing.assert_allclose(followed(time, u, [tau] * 5), expected, rtol=0, atol=1e-11)


def test_nothing_lags_where_it_is_off_and_columns_do_not_meet():
    rng = np.random.default_rng(3)
    time, u = np.cumsum(rng.uniform(0.005, 0.05, 150)), rng.normal(size=(150, 3))
    constants = rng.uniform(0.0, 0.3, (5, 3))
    constants[:, 1] = 0.0
    low, high = np.array([-1.0, -2.0, 0.0]), np.array([1.0, 2.0, 3.0])
    together = lag_with_level(time, u, low, high, constants)
    assert np.array_equal(together[:, 1], u[:, 1])
    for j in range(3):
        alone = lag_with_level(time, u[:, [j]], low[[j]], high[[j]], constants[:, [j]])
        assert np.array_equal(alone[:, 0], together[:, j])


@pytest.mark.parametrize("constants", [(0.0, 0.2, 0.0, 0.0, 0.1), (1e300, 1e-300, 0.0, 1e-300, 1e300)])
def test_constants_at_the_ends_of_their_boxes(constants):
    time, u = wave(150)
    found = followed(time, u, constants)
    assert np.all(np.isfinite(found))
    assert u.min() - 1e-12 <= found.min()
    assert found.max() <= u.max() + 1e-12

"""A lag by a curve of the rate, against a tight ODE solution, the first-order lag and closed forms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hysteresis_bench.kernels.lag import lag
from hysteresis_bench.kernels.lag_curve import lag_curve

KNOT = 2.0
CURVES = {
    "slower down": (0.3, 0.3, 0.05, 0.05),
    "slower the faster": (0.6, 0.04, 0.02, 0.5),
    "faster the faster": (0.01, 0.2, 0.3, 0.02),
    "all four": (0.5, 0.1, 0.03, 0.2),
}


def grid(rng, samples=150):
    return np.cumsum(rng.uniform(0.005, 0.05, samples))


def rate_at(distance, constants):
    """The inverse of g, in plain Python."""
    fast, slow = (constants[3], constants[2]) if distance >= 0.0 else (constants[0], constants[1])
    size = abs(distance)
    rate = size / slow if size < slow * KNOT else KNOT + (size - slow * KNOT) / fast
    return np.sign(distance) * rate


@pytest.mark.parametrize("constants", CURVES.values(), ids=CURVES.keys())
@pytest.mark.parametrize("seed", [1, 2])
def test_agrees_with_a_tight_ode_solution(constants, seed):
    rng = np.random.default_rng(seed)
    time = grid(rng)
    u = np.cumsum(rng.normal(size=time.size)) * 0.2
    expected = [u[0]]
    for i in range(1, time.size):
        ends = time[i - 1 : i + 1]

        def slope(t, v, ends=ends, i=i):
            return [rate_at(np.interp(t, ends, u[i - 1 : i + 1]) - v[0], constants)]

        found = solve_ivp(slope, ends, expected[-1:], rtol=1e-11, atol=1e-12, max_step=(ends[1] - ends[0]) / 50)
        expected.append(found.y[0, -1])
    v = lag_curve(time, u[:, None], np.array([KNOT]), np.array(constants)[:, None])[:, 0]
    np.testing.assert_allclose(v, expected, rtol=0, atol=2e-7)
    assert u.min() <= v.min()
    assert v.max() <= u.max()


@pytest.mark.parametrize("tau", [1e-9, 0.004, 0.08, 1.5, 1e6])
def test_one_slope_is_the_first_order_lag(tau):
    rng = np.random.default_rng(7)
    for time in (np.arange(300) * 0.01, grid(rng, 300)):
        u = rng.normal(size=time.size)[:, None]
        found = lag_curve(time, u, np.array([KNOT]), np.full((4, 1), tau))
        np.testing.assert_allclose(found, lag(time, u, np.array([tau])), rtol=0, atol=2e-8 if tau < 1e-6 else 1e-11)


def test_nothing_lags_where_it_is_off_and_columns_do_not_meet():
    rng = np.random.default_rng(3)
    time, u = grid(rng), rng.normal(size=(150, 3))
    constants = rng.uniform(0.01, 0.3, (4, 3))
    constants[:, 1] = 0.0
    knot = np.array([1.0, 2.0, 3.0])
    together = lag_curve(time, u, knot, constants)
    assert np.array_equal(together[:, 1], u[:, 1])
    for j in range(3):
        alone = lag_curve(time, u[:, j : j + 1], knot[j : j + 1], constants[:, j : j + 1])
        assert np.array_equal(alone[:, 0], together[:, j])


def test_a_slew_rate_limit():
    """Behind a step: a straight line at the limit, where nothing lags below it."""
    time = np.linspace(0.0, 1.0, 1001)
    u = np.where(time > 0.1, 1.0, 0.0)[:, None]
    v = lag_curve(time, u, np.array([KNOT]), np.array([[1e9], [0.0], [0.0], [1e9]]))[:, 0]
    np.testing.assert_allclose(v, np.clip(KNOT * (time - 0.1), 0.0, 1.0), rtol=0, atol=3e-3)


@pytest.mark.parametrize("constants", [(0.0, 0.2, 0.0, 0.0), (0.0, 0.0, 0.0, 0.3), (1e300, 1e-300, 1e-300, 1e300)])
def test_constants_at_the_ends_of_their_boxes(constants):
    rng = np.random.default_rng(5)
    time, u = grid(rng), rng.normal(size=(150, 1)) * 1e3
    v = lag_curve(time, u, np.array([KNOT]), np.array(constants)[:, None])
    assert np.all(np.isfinite(v))
    assert u.min() <= v.min()
    assert v.max() <= u.max()

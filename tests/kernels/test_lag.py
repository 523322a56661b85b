"""The compiled lags against scipy's linear simulation, a tight ODE solution and closed forms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import lsim

from hysteresis_bench.kernels import lag as kernels
from tests.conftest import as_models_call

lag = as_models_call(kernels.lag, 0, 1)
late_response = as_models_call(kernels.late_response, 0)
weighted_lags = as_models_call(kernels.weighted_lags, 0)

TAUS = np.array([0.0, 1e-9, 0.003, 0.05, 0.4, 7.0, 1e12])


def uneven_grid(rng: np.random.Generator, samples: int = 120) -> np.ndarray:
    return np.cumsum(rng.uniform(1e-4, 0.03, samples))


def test_agrees_with_linear_simulation_on_an_even_grid():
    time = np.linspace(0.0, 2.0, 401)
    u = np.sin(9.0 * time) + 0.3 * np.sign(np.sin(23.0 * time)) + 2.0
    v = lag(time, u[:, None], TAUS)
    for column, tau in enumerate(TAUS):
        if 1e-3 < tau < 1e3:
            _, expected, _ = lsim(([[-1 / tau]], [[1 / tau]], [[1.0]], [[0.0]]), u, time, X0=[u[0]])
            np.testing.assert_allclose(v[:, column], expected, rtol=0, atol=1e-11)


@pytest.mark.parametrize("tau", [0.004, 0.08, 1.5])
def test_agrees_with_a_tight_ode_solution_on_an_uneven_grid(tau):
    rng = np.random.default_rng(1)
    time = uneven_grid(rng)
    u = rng.normal(size=time.size)
    expected = [u[0]]
    for i in range(1, time.size):  # a segment at a time: u has kinks at the samples
        span = (time[i - 1], time[i])

        def slope(t, v, i=i):
            return (np.interp(t, time[i - 1 : i + 1], u[i - 1 : i + 1]) - v) / tau

        expected.append(solve_ivp(slope, span, expected[-1:], rtol=1e-12, atol=1e-13).y[0, -1])
    v = lag(time, u[:, None], np.array([tau]))[:, 0]
    np.testing.assert_allclose(v, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("tau", [0.003, 0.05, 0.4])
def test_agrees_with_the_recurrence_for_x_itself(tau):
    """x_1 = u_1 - s tau + (x_0 - u_0 + s tau) exp(-h / tau), s the slope over the step, in plain Python.

    That form loses digits by tau / h, up to 80 here; the kernel's does not.
    """
    rng = np.random.default_rng(7)
    for time in (np.arange(120) * 0.01, np.cumsum(rng.uniform(0.005, 0.03, 120))):
        u = rng.normal(size=time.size)
        expected = [u[0]]
        for i in range(1, time.size):
            h = time[i] - time[i - 1]
            drop = (u[i] - u[i - 1]) / h * tau
            expected.append(u[i] - drop + (expected[-1] - u[i - 1] + drop) * np.exp(-h / tau))
        np.testing.assert_allclose(lag(time, u[:, None], np.array([tau]))[:, 0], expected, rtol=0, atol=1e-13)


def test_ramp_and_step_have_their_closed_forms():
    rng = np.random.default_rng(2)
    time = uneven_grid(rng)
    since, tau = time - time[0], 0.2
    ramp = lag(time, (3.0 + 5.0 * since)[:, None], np.array([tau]))[:, 0]
    np.testing.assert_allclose(ramp, 3.0 + 5.0 * (since - tau * (1 - np.exp(-since / tau))), atol=1e-12)
    edges = np.concatenate([[-1e-9, 0.0], since[1:]])
    step = lag(edges, np.concatenate([[0.0], np.ones(edges.size - 1)])[:, None], np.array([tau]))[:, 0]
    np.testing.assert_allclose(step, 1 - np.exp(-np.maximum(edges, 0) / tau), atol=1e-8)


def test_a_sine_is_damped_and_delayed_as_a_low_pass_does():
    tau, omega = 0.3, 5.0
    time = np.linspace(0.0, 8.0, 40001)
    v = lag(time, np.sin(omega * time)[:, None], np.array([tau]))[:, 0]
    settled = time > 20 * tau
    expected = np.sin(omega * time - np.arctan(omega * tau)) / np.hypot(1.0, omega * tau)
    np.testing.assert_allclose(v[settled], expected[settled], atol=1e-6)


def test_no_lag_is_the_input_to_the_last_bit_and_an_endless_one_stays_at_rest():
    rng = np.random.default_rng(3)
    time, u = uneven_grid(rng), rng.normal(size=(120, 3)) * np.array([1e-9, 1.0, 1e9])
    assert np.array_equal(lag(time, u, np.zeros(3)), u)
    still = lag(time, u, np.full(3, 1e300))
    np.testing.assert_allclose(still, np.broadcast_to(u[0], u.shape), atol=1e-6 * np.abs(u).max(axis=0).min())


def test_a_swarm_is_its_columns_with_shared_and_with_own_inputs():
    rng = np.random.default_rng(4)
    time, own = uneven_grid(rng), rng.normal(size=(120, TAUS.size))
    shared = lag(time, own[:, :1], TAUS)
    each = lag(time, own, TAUS)
    for j in range(TAUS.size):
        assert np.array_equal(shared[:, j], lag(time, own[:, :1], TAUS[j : j + 1])[:, 0])
        assert np.array_equal(each[:, j], lag(time, own[:, j : j + 1], TAUS[j : j + 1])[:, 0])


@pytest.mark.parametrize("swarm", [1, 3, 50, 130])
@pytest.mark.parametrize("lags", [1, 5, 7, 9])
def test_late_responses_in_place_are_those_in_a_new_array(swarm, lags):
    rng = np.random.default_rng(5)
    time, u = np.cumsum(rng.uniform(0.1, 1.0, 40)), rng.normal(size=(40, swarm))
    weights, taus = rng.normal(size=(lags, swarm)), 10.0 ** rng.uniform(-3.0, 2.0, (lags, swarm))
    for late, share in ((late_response, weights[0]), (weighted_lags, weights)):
        expected, here = late(time, u, share, taus), u.copy()
        assert late(time, here, share, taus, here) is here
        np.testing.assert_array_equal(here, expected)
    mixed = u + sum(weights[k] * (lag(time, u, taus[k]) - u) for k in range(lags))
    np.testing.assert_allclose(weighted_lags(time, u, weights, taus), mixed, rtol=0, atol=1e-12)


def test_a_late_response_is_a_mixture_of_lags():
    rng = np.random.default_rng(5)
    time, u = uneven_grid(rng), rng.normal(size=(120, 1))
    share, taus = np.array([0.0, 0.2, 0.7]), rng.uniform(0.001, 2.0, (4, 3))
    mean = np.mean([lag(time, u, row) for row in taus], axis=0)
    late = late_response(time, u, share, taus)
    np.testing.assert_allclose(late, (1 - share) * u + share * mean, atol=1e-13)
    assert np.array_equal(late[:, 0], u[:, 0])


def test_rounding_of_the_grid_does_not_matter():
    exact = np.arange(2000) * 0.001
    shifted = 1e4 + exact  # steps now differ in their eighth digit
    u = np.sin(exact)[:, None]
    taus = np.array([0.02])
    np.testing.assert_allclose(lag(shifted, u, taus), lag(exact, u, taus), atol=1e-9)

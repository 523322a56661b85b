"""The second-order stage against scipy's simulation, matrix exponentials and closed forms."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.signal import StateSpace, lsim

from hysteresis_bench.kernels import second_order as kernels
from tests.conftest import as_models_call

second_order = as_models_call(kernels.second_order, 0)

PUBLISHED = (510.1069, 255_700.0)  # PEA paper, Table 3, G-Pmix: c/m, k/m
STAGES = {"underdamped": PUBLISHED, "critical": (1000.0, 250_000.0), "overdamped": (4000.0, 255_700.0)}


def run(time, u, *stages):
    damping, stiffness = (np.array(values, dtype=float) for values in zip(*stages, strict=True))
    return second_order(time, u, damping, stiffness)


def by_expm(time, u, damping, stiffness):
    """Each step by the exponential of the system augmented with its linear input."""
    system = np.array([[0, 1, 0, 0], [-stiffness, -damping, stiffness, 0], [0, 0, 0, 1], [0, 0, 0, 0]], dtype=float)
    state, out = np.array([u[0], 0.0]), [u[0]]
    for i in range(1, time.size):
        step = time[i] - time[i - 1]
        state = (expm(system * step) @ [*state, u[i - 1], (u[i] - u[i - 1]) / step])[:2]
        out.append(state[0])
    return np.array(out)


@pytest.mark.parametrize("stage", STAGES.values(), ids=STAGES)
def test_equals_scipy_for_a_piecewise_linear_input(stage):
    time = np.arange(2000) * 5e-4
    u = np.sin(2 * np.pi * 30 * time) * time
    damping, stiffness = stage
    system = StateSpace([[0, 1], [-stiffness, -damping]], [[0], [stiffness]], [[1, 0]], [[0]])
    _, expected, _ = lsim(system, u, time, interp=True)
    np.testing.assert_allclose(run(time, u[:, None], stage)[:, 0], expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("stage", STAGES.values(), ids=STAGES)
def test_equals_matrix_exponentials_on_an_uneven_grid(stage):
    rng = np.random.default_rng(3)
    time = np.cumsum(rng.uniform(1e-5, 2e-2, 300))
    u = rng.normal(size=300)
    np.testing.assert_allclose(run(time, u[:, None], stage)[:, 0], by_expm(time, u, *stage), rtol=0, atol=1e-11)


def test_ramp_response_is_the_closed_form():
    damping, stiffness = PUBLISHED
    time = np.linspace(0, 0.05, 101)
    omega = np.sqrt(stiffness - damping**2 / 4)
    lag = damping / stiffness
    transient = lag * np.cos(omega * time) + (damping * lag / 2 - 1) / omega * np.sin(omega * time)
    expected = time - lag + np.exp(-damping * time / 2) * transient
    np.testing.assert_allclose(run(time, time[:, None], PUBLISHED)[:, 0], expected, rtol=0, atol=1e-15)


def test_is_continuous_through_critical_damping():
    time = np.linspace(0, 0.1, 500)
    u = np.sin(200 * time)[:, None]
    stages = [(1000.0 * (1 + shift), 250_000.0) for shift in (-1e-6, -1e-12, 0.0, 1e-12, 1e-6)]
    y = run(time, u, *stages)
    assert np.abs(np.diff(y, axis=1)).max() < 1e-6
    np.testing.assert_allclose(y[:, 1], y[:, 3], rtol=0, atol=1e-10)


def test_rests_in_static_equilibrium_with_the_first_sample():
    y = run(np.linspace(0, 1, 50), np.full((50, 1), 3.7), *STAGES.values())
    np.testing.assert_array_equal(y, np.full((50, 3), 3.7))


def test_an_infinite_stiffness_returns_the_input_to_the_last_bit():
    rng = np.random.default_rng(4)
    u = rng.normal(size=(300, 1))
    y = run(np.arange(300.0), u, (np.inf, np.inf), PUBLISHED)
    np.testing.assert_array_equal(y[:, :1], u)
    assert not np.array_equal(y[:, 1:], u)


def test_one_input_a_stage_equals_a_shared_input():
    rng = np.random.default_rng(5)
    time, u = np.cumsum(rng.uniform(0.5e-3, 2e-3, 200)), rng.normal(size=(200, 3))
    together = run(time, u, *STAGES.values())
    for j, stage in enumerate(STAGES.values()):
        np.testing.assert_allclose(together[:, j], run(time, u[:, j : j + 1].copy(), stage)[:, 0], rtol=0, atol=1e-12)


def test_an_unstable_stage_stays_finite():
    u = np.sin(np.arange(3000.0))[:, None]
    stages = [(-1.0, 1.0), (-1e6, 1.0), (0.0, -1e6), (1.0, 0.0), (-5.0, -5.0), (0.0, 0.0), (-1e3, 1e4)]
    assert np.isfinite(run(np.arange(3000.0), u, *stages)).all()


@pytest.mark.parametrize("stage", STAGES.values(), ids=STAGES)
def test_a_lead_passes_a_part_of_the_velocity_on(stage):
    time = np.arange(2000) * 5e-4
    u = 1.0 + np.sin(2 * np.pi * 30 * time) * time
    (damping, stiffness), lead = stage, 3e-3
    system = StateSpace([[0, 1], [-stiffness, -damping]], [[0], [stiffness]], [[1, lead]], [[0]])
    _, expected, _ = lsim(system, u, time, X0=[1.0, 0.0], interp=True)
    leads = np.array([lead, 0.0])
    for columns in (u[:, None], np.repeat(u[:, None], 2, axis=1)):
        found = as_models_call(kernels.leading_second_order, 0)(
            time, columns, *(np.full(2, value) for value in stage), leads
        )
        np.testing.assert_allclose(found[:, 0], expected, rtol=0, atol=1e-12)
        np.testing.assert_allclose(found[:, 1], run(time, u[:, None], stage)[:, 0], rtol=0, atol=1e-14)


@pytest.mark.parametrize("damping", [0.03, 0.3, 1.0, 4.0])
@pytest.mark.parametrize("frequency", [0.3, 5.0, 40.0])
def test_modes_are_a_first_order_hold(damping, frequency):
    from scipy.signal import cont2discrete, lfilter

    from hysteresis_bench.kernels.second_order import modes

    step, u = 0.02, np.cumsum(np.random.default_rng(3).standard_normal(300))
    found = modes(step, u, frequency, np.array([0.5, damping]))[:, 2:]
    for column, numerator in zip(found.T, ([1.0], [1.0 / frequency, 0.0]), strict=True):
        system = (numerator, [1.0 / frequency**2, 2.0 * damping / frequency, 1.0])
        b, a, _ = cont2discrete(system, step, method="foh")
        assert column == pytest.approx(lfilter(b.ravel(), a, u - u[0]), abs=1e-8 * np.ptp(u))

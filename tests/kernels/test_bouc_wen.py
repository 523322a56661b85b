"""The Bouc-Wen kernels against a tight ODE solution, a plain-Python twin and closed forms."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hysteresis_bench.kernels import bouc_wen as with_1
from hysteresis_bench.kernels import bouc_wen_power as with_any
from hysteresis_bench.kernels.bouc_wen_step import grown, integrated, moved
from tests.conftest import as_models_call

bouc_wen = as_models_call(with_1.bouc_wen, 0)
bouc_wen_power = as_models_call(with_any.bouc_wen_power, 0)

PUBLISHED = (0.304225, 0.675313, 0.497724, 1.045814)  # PEA paper, Table 2, G-Pmix


def columns(*particles):
    return [np.array(values, dtype=float) for values in zip(*particles, strict=True)]


def sine(samples=6000, amplitude=2.5, cycles=3):
    return amplitude * np.sin(2 * np.pi * cycles * np.linspace(0, 1, samples))[:, None]


def by_ode(u, p, n=1.0, every=1):
    """[1] eq. (1) solved in u between turning points, with the kink at h = 0 found as an event."""
    alpha, beta, gamma, d = p
    turns = np.nonzero(np.diff(np.sign(np.diff(u))))[0] + 1
    edges = [0, *turns, u.size - 1]
    h = np.zeros(u.size)
    for first, last in itertools.pairwise(edges):
        sign = np.sign(u[last] - u[first])
        widths = np.abs(u[first : last + 1] - u[first])

        def rate(w, x, sign=sign):
            return alpha * d * sign - beta * abs(x) ** (n - 1) * x - gamma * sign * abs(x) ** n

        def crossing(w, x):
            return x[0]

        crossing.terminal = True
        start, state = 0.0, h[first]
        while start < widths[-1]:
            nudged = solve_ivp(
                rate, (start, widths[-1]), [state], "DOP853", dense_output=True, rtol=1e-12, atol=1e-14,
                events=crossing if state * sign < 0 else None,
            )  # fmt: skip
            inside = (widths > start) & (widths <= nudged.t[-1])
            h[first : last + 1][inside] = nudged.sol(widths[inside])[0]
            crossed = nudged.status == 1
            start, state = nudged.t[-1], 0.0 if crossed else nudged.y[0, -1]
    return d * u - h


def twin(u, alpha, beta, gamma, d):
    """The closed form, one particle, one sample at a time, in plain Python."""
    h, out = 0.0, [d * u[0]]
    for before, now in itertools.pairwise(u):
        width, sign = abs(now - before), math.copysign(1.0, now - before)
        while width > 0.0:
            rate = beta + gamma * sign * (math.copysign(1.0, h) if h != 0.0 else math.copysign(1.0, sign * alpha * d))
            target = alpha * d * sign
            if h * target < 0.0:  # up to the crossing, then on
                reach = -h / target if rate == 0.0 else math.log1p(-rate * h / target) / rate
                if reach < width:
                    h, width = 0.0, width - reach
                    continue
            h += (target - rate * h) * (width if rate == 0.0 else -math.expm1(-rate * width) / rate)
            width = 0.0
        out.append(d * now - h)
    return np.array(out)


@pytest.mark.parametrize("amplitude", [2.5, 40.0])
def test_agrees_with_a_tight_ode_solution(amplitude):
    u = sine(amplitude=amplitude)
    reference = by_ode(u[:, 0], PUBLISHED)
    error = np.abs(bouc_wen(u, *columns(PUBLISHED))[:, 0] - reference).max()
    assert error < 1e-10 * np.ptp(reference)


@pytest.mark.parametrize("steps", [1.0, 30.0, 300.0])
def test_steps_on_which_an_exponential_overflows_agree_with_the_plain_twin(steps):
    """gamma - beta = 7: after a reversal h grows by up to e^2100 a sample, were it not to cross 0."""
    u = np.random.default_rng(6).uniform(-steps, steps, (100, 1))
    expected = twin(u[:, 0], 0.3, 0.5, 7.5, 1.3)
    for inputs in (u, np.repeat(u, 2, axis=1)):
        found = bouc_wen(inputs, *columns((0.3, 0.5, 7.5, 1.3), (0.3, 0.5, 7.5, 1.3)))
        assert np.abs(found - expected[:, None]).max() < 1e-13 * np.ptp(expected)


@pytest.mark.parametrize("n", [1.2, 1.5, 2.0, 2.7, 3.0, 6.5])
@pytest.mark.parametrize("samples", [40, 600, 6000])
def test_other_powers_agree_with_a_tight_ode_solution(n, samples):
    u = sine(samples)
    for p in (PUBLISHED, (0.6, 1.5, -0.9, 1.8), (0.6, 0.3, 1.9, 1.8)):
        reference = by_ode(u[:, 0], p, n)
        error = np.abs(bouc_wen_power(u, *columns(p), n)[:, 0] - reference).max()
        assert error < (1e-9 if n in (2.0, 3.0) else 1e-8) * np.ptp(p[3] * u[:, 0] - reference)


@pytest.mark.parametrize("n", [1.3, 2.0, 3.0, 4.0])
def test_other_powers_of_a_swarm_agree_with_the_step_for_one_particle(n):
    rng = np.random.default_rng(9)
    swarm = 70  # more than one block of lanes
    alpha, beta, gamma, d = (rng.uniform(low, 3, swarm) for low in (-1, 0.1, -0.05, -1))
    for u in (np.cumsum(rng.normal(size=(60, 1)), axis=0), np.cumsum(0.02 * rng.normal(size=(400, swarm)), axis=0)):
        simulated = bouc_wen_power(u, alpha, beta, gamma, d, n)
        for j in range(0, swarm, 7):
            inputs, h, expected = u[:, j % u.shape[1]], 0.0, [0.0]
            for step in np.diff(inputs):
                h = moved(h, step, alpha[j] * d[j], beta[j], gamma[j], n, np.inf)
                expected.append(h)
            found = d[j] * inputs - simulated[:, j]
            np.testing.assert_allclose(found, expected, rtol=0, atol=2e-9 * np.ptp(expected))


@pytest.mark.parametrize("n", [1.5, 2.0, 2.5, 3.0, 4.0, 5.0])
def test_a_long_step_from_near_0_is_told_from_a_short_one(n):
    """There all derivatives of |h|^(n-1) h are next to nothing, and say nothing of how long a step may be."""
    rng = np.random.default_rng(7)
    for _ in range(40):
        steps = rng.choice([1e-4, 1e-3, 1e-2, 0.1, 0.5, 2.0], 12) * rng.uniform(-1.0, 1.0, 12)
        u, p = np.concatenate([[0.0], np.cumsum(steps)]), rng.uniform([0.1, 0.2, -0.2, 0.5], [1.0, 3.0, 0.2, 2.0])
        found, h = bouc_wen_power(u[:, None], *columns(p), n)[:, 0], 0.0
        for i, step in enumerate(np.diff(u), 1):
            h = moved(h, step, p[0] * p[3], p[1], p[2], n, np.inf)
            assert abs(found[i] - (p[3] * u[i] - h)) <= 3e-8 * np.ptp(found)


@pytest.mark.parametrize("n", [1.3, 2.0, 3.0, 4.0])
def test_the_crossing_of_0_in_few_terms_is_that_of_the_whole_series(n):
    rng = np.random.default_rng(10)
    for _ in range(300):
        drive, width = 10.0 ** rng.uniform(-3.0, 3.0, 2)
        along, against = rng.uniform(-1.0, 1.0, 2) * 10.0 ** rng.uniform(-8.0, 0.0) * drive / (drive * width) ** n
        g = -drive * width * rng.uniform(0.0, 1.0)
        expected = integrated(g, drive, along, against, n, width, np.inf)
        found = grown(g, drive, along, against, n, width, np.inf)
        assert abs(found - expected) <= 1e-11 * drive * width
    assert grown(0.0, 0.0, 1.0, 1.0, n, 1.0, np.inf) == 0.0


@pytest.mark.parametrize("samples", [20, 300, 3000])
def test_agrees_with_its_plain_twin_for_a_swarm_however_coarse_the_samples(samples):
    rng = np.random.default_rng(1)
    u = np.cumsum(rng.normal(size=(samples, 1)), axis=0) * 20 / np.sqrt(samples)
    swarm = 70  # more than one block of lanes
    alpha, beta, gamma, d = (rng.uniform(low, 3, swarm) for low in (-1, 0.1, -0.1, -1))
    simulated = bouc_wen(u, alpha, beta, gamma, d)
    for j in range(0, swarm, 7):
        expected = twin(u[:, 0], alpha[j], beta[j], gamma[j], d[j])
        assert np.abs(simulated[:, j] - expected).max() < 1e-11 * np.ptp(expected)


def test_one_input_a_particle_equals_a_shared_input():
    rng = np.random.default_rng(2)
    inputs = np.cumsum(rng.normal(size=(400, 5)), axis=0)
    parameters = [rng.uniform(0, 2, 5) for _ in range(4)]
    together = bouc_wen(inputs, *parameters)
    for j in range(5):
        alone = bouc_wen(inputs[:, j : j + 1].copy(), *(values[j : j + 1] for values in parameters))
        np.testing.assert_allclose(together[:, j], alone[:, 0], rtol=0, atol=1e-11 * np.ptp(alone))


@pytest.mark.parametrize("n", [1.0, 2.0, 3.0])
@pytest.mark.parametrize("swarm", [1, 3, 4, 65, 4097])
def test_a_particle_is_the_same_in_a_swarm_of_any_size(n, swarm):
    rng = np.random.default_rng(7)
    parameters = [rng.uniform(low, 2, swarm) for low in (-1, 0.1, -0.1, 0.2)]
    for u in (sine(60), np.cumsum(rng.normal(0.0, 0.2, (60, swarm)), axis=0)):
        together = bouc_wen(u, *parameters) if n == 1.0 else bouc_wen_power(u, *parameters, n)
        for j in {0, swarm // 2, swarm - 1}:
            own, one = np.ascontiguousarray(u[:, [j % u.shape[1]]]), [values[[j]] for values in parameters]
            alone = bouc_wen(own, *one) if n == 1.0 else bouc_wen_power(own, *one, n)
            atol = (1e-12 if n == 1.0 else 1e-9) * np.ptp(alone)
            np.testing.assert_allclose(together[:, j], alone[:, 0], rtol=0, atol=atol)


def test_a_power_of_2_is_exact_on_every_increment():
    """dh/du = A - rate h^2 from rest: h = sqrt(A / rate) tanh(sqrt(A rate) u)."""
    alpha, beta, gamma, d = PUBLISHED
    u = np.linspace(0.0, 3.0, 40)[:, None]
    rate, drive = beta + gamma, alpha * d
    expected = d * u[:, 0] - np.sqrt(drive / rate) * np.tanh(np.sqrt(drive * rate) * u[:, 0])
    assert np.abs(bouc_wen_power(u, *columns(PUBLISHED), 2.0)[:, 0] - expected).max() < 1e-14


def test_saturates_at_the_closed_form_height():
    alpha, beta, gamma, d = PUBLISHED
    u = np.linspace(0, 100, 2000)[:, None]
    h = d * u[-1, 0] - bouc_wen(u, *columns(PUBLISHED))[-1, 0]
    assert h == pytest.approx(alpha * d / (beta + gamma), rel=1e-12)


def test_starts_at_rest_wherever_the_input_starts():
    v = bouc_wen(sine(100) + 7.0, *columns(PUBLISHED))
    assert v[0, 0] == PUBLISHED[3] * 7.0


@pytest.mark.parametrize("kernel", [bouc_wen, lambda *arguments: bouc_wen_power(*arguments, 2.5)])
@pytest.mark.parametrize("samples", [12, 500])
def test_is_finite_whatever_the_signs_and_sizes(kernel, samples):
    sizes = (-1e4, -5.0, -0.3, 0.0, 1e-12, 0.3, 5.0, 1e4)
    beta, gamma = (values.ravel() for values in np.meshgrid(sizes, sizes))
    u = sine(samples, amplitude=10.0)
    for alpha, d in ((0.3, 1.0), (-2.0, 1.0), (0.3, -1.0), (0.0, 1.0), (0.3, 0.0)):
        v = kernel(u, np.full_like(beta, alpha), beta, gamma, np.full_like(beta, d))
        assert np.isfinite(v).all()


def test_is_finite_where_the_bound_is_where_it_runs_away():
    """beta = 0: after a long increment h is at rest at the edge of running away, and the next one takes it along."""
    u = 551.6 * np.array([0.0, 0.0, -1.0, 1.0, 0.0, -1.0, 0.0, 0.0, 1.0, -1.0] * 3)[:, None]
    v = bouc_wen(u, *(np.array([value]) for value in (2.5, 0.0, 3.8, 4.63)))
    assert np.all(np.isfinite(v))


def test_changes_no_argument():
    u, parameters = sine(50), columns(PUBLISHED, PUBLISHED)
    before = [values.copy() for values in (u, *parameters)]
    bouc_wen(u, *parameters)
    bouc_wen_power(u, *parameters, 2.0)
    for values, kept in zip((u, *parameters), before, strict=True):
        np.testing.assert_array_equal(values, kept)

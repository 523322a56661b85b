"""The eddy-current kernels against a tight ODE, the law itself, an exact lag, and the kernels without."""

import itertools
import math
from types import SimpleNamespace

import numpy as np
import pytest
from numba import njit
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from hysteresis_bench.kernels.bouc_wen_step import moved
from hysteresis_bench.kernels.eddy_current import end_weight
from hysteresis_bench.kernels.jiles_atherton import MU0, advanced, extrapolated, first_anhysteretic
from hysteresis_bench.kernels.lag import lag
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import read_only
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.models.free_energy import FreeEnergy
from hysteresis_plugins.models.jiles_atherton import JilesAtherton
from hysteresis_plugins.models.jiles_atherton_clamped import JilesAthertonClamped

LAWS = {
    "bouc-wen": (BoucWen(), {"alpha": 0.6, "beta": 2.0, "gamma": 0.5, "d": 1.3}),
    "bouc-wen, n = 1.5": (BoucWen(1.5), {"alpha": 0.6, "beta": 2.0, "gamma": 0.5, "d": 1.3}),
    # so reversible that B never falls while H rises, though M_irr does
    "jiles-atherton": (JilesAtherton(), {"alpha": 1e-7, "a": 0.3, "k": 0.2, "M_s": 1e6, "c": 0.8}),
    "jiles-atherton-clamped": (JilesAthertonClamped(), {"alpha": 1e-7, "a": 0.3, "k": 0.2, "M_s": 1e6, "c": 0.2}),
    "free-energy": (FreeEnergy(), {"M_R": 1.0, "eta": 10.0, "H_c": 0.3, "b": 0.3, "c": 0.3, "alpha": 3.0}),
}


def driven(samples: int, frequency: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Two tones, with inner loops."""
    time = np.linspace(0.0, 2.0 / frequency, samples)
    phase = 2 * np.pi * frequency * time
    return time, np.sin(phase) + 0.4 * np.sin(3.5 * phase)


def plain(name: str, u: np.ndarray, swarm: int = 1) -> np.ndarray:
    model, values = LAWS[name]
    return model._plain(
        read_only(np.atleast_2d(u.T).T), SimpleNamespace(**{key: np.full(swarm, x) for key, x in values.items()})
    )


def dragged(name: str, time: np.ndarray, u: np.ndarray, *coefficients: float) -> np.ndarray:
    model, values = LAWS[name]
    p = SimpleNamespace(**{key: np.full(len(coefficients), x) for key, x in values.items()})
    return model._dragged(read_only(time), read_only(np.atleast_2d(u.T).T), np.array(coefficients, dtype=float), p)


def bouc_wen_law(n, alpha, beta, gamma, d):
    """F(before, z) -> y and what to remember: one particle of `eddy_bouc_wen`, in plain Python."""

    def law(before, z):
        at, h = before or (z, 0.0)
        h = moved.py_func(h, z - at, alpha * d, beta, gamma, n, math.inf)
        return d * z - h, (z, h)

    return law


def jiles_atherton_law(clamped, alpha, a, k, M_s, c):
    def law(before, z):
        if before is None:
            D = first_anhysteretic.py_func(z, alpha, a, M_s, c)
            return MU0 * (z + c * D), (z, 0.0, 0.0, D, c * D, 0.0, 0.0)
        at, last, Mi, D, M, rise_D, rise_M = before
        dH = z - at
        if dH == 0.0:
            return MU0 * (z + M), before
        Mi, D_, M_ = advanced.py_func(
            z, abs(dH), math.copysign(1.0, dH), extrapolated.py_func(dH, last),
            alpha, 1.0 / a, alpha * M_s / a, k, M_s, c, Mi, D, M, rise_D, rise_M, clamped,
        )  # fmt: skip
        return MU0 * (z + M_), (z, dH, Mi, D_, M_, D_ - D, M_ - M)

    return law


TWINS = {
    "bouc-wen": lambda **p: bouc_wen_law(1.0, **p),
    "bouc-wen, n = 1.5": lambda **p: bouc_wen_law(1.5, **p),
    "jiles-atherton": lambda **p: jiles_atherton_law(False, **p),
    "jiles-atherton-clamped": lambda **p: jiles_atherton_law(True, **p),
}


def twin(law, time, u, coefficient):
    """The equation of `eddy_current`, solved for one particle by scipy."""
    y, state = law(None, u[0])
    z, outputs = u[0], [y]
    for i in range(1, u.size):
        rate, lead = coefficient / (time[i] - time[i - 1]), u[i] - z
        steepness = rate * (law(state, u[i])[0] - y) / lead if lead != 0.0 else 0.0
        theta = 0.5 + 0.5 / math.tanh(0.5 / steepness) - steepness if steepness > 0.0 else 1.0
        behind = z - u[i - 1]
        end = np.clip(u[i] - (1.0 - theta) / theta * behind, min(u[i - 1], u[i]), max(u[i - 1], u[i]))
        along = 1.0 if end > z else -1.0
        before = -abs(behind - theta * (u[i] - u[i - 1]))

        def value(way, start=z, here=state, y=y, rate=rate, theta=theta, along=along, before=before):
            rise = along * (law(here, start + along * way)[0] - y)
            return before + theta * way + rate * max(rise, 0.0)

        way = abs(end - z)
        if value(way) > 0.0:
            way = brentq(value, 0.0, way, xtol=1e-14, rtol=1e-14)
        z += along * way
        y, state = law(state, z)
        outputs.append(y)
    return np.array(outputs)


@pytest.mark.parametrize("name", TWINS)
@pytest.mark.parametrize("samples", [40, 300])
def test_a_plain_solution_of_the_same_equation_agrees(name, samples):
    time, u = driven(samples)
    law = TWINS[name](**LAWS[name][1])
    coefficients = (1e-3, 0.02, 0.5)
    found = dragged(name, time, u, *coefficients)
    for j, coefficient in enumerate(coefficients):
        expected = twin(law, time, u, coefficient)
        np.testing.assert_allclose(found[:, j], expected, atol=1e-8 * np.ptp(expected))


def test_so_it_does_for_bouc_wen_on_steps_of_any_size():
    """Most steps cross h = 0, some change h by its whole range or by none."""
    rng = np.random.default_rng(5)
    time = np.cumsum(10.0 ** rng.uniform(-3.0, 1.0, 120))
    u = np.cumsum(rng.normal(size=120) * 10.0 ** rng.uniform(-3.0, 1.0, 120))
    u[40:43] = u[40]
    drawn = {
        "alpha": rng.uniform(-50.0, 1.0, 30) * (np.arange(30) > 0),
        "beta": 10.0 ** rng.uniform(-2.0, 2.0, 30),
        "d": rng.uniform(0.0, 2.0, 30) * (np.arange(30) > 1),
    }
    drawn["gamma"] = drawn["beta"] * rng.uniform(-0.99, 0.99, 30)
    drawn["gamma"][2] = drawn["beta"][2] = 1.0  # rates 2 and 0
    coefficients = 10.0 ** rng.uniform(-4.0, 2.0, 30)
    found = BoucWen()._dragged(read_only(time), read_only(u[:, None]), coefficients, SimpleNamespace(**drawn))
    for j in range(30):
        law = bouc_wen_law(1.0, **{name: values[j] for name, values in drawn.items()})
        expected = twin(law, time, u, coefficients[j])
        np.testing.assert_allclose(found[:, j], expected, atol=1e-9 * np.ptp(expected))


@pytest.mark.parametrize("n", [1.0, 1.5])
def test_it_stays_finite_wherever_the_parameters_are(n):
    """Corners with h unbounded, no drive, no rates; two samples, equal ones and long steps."""
    values = (-200.0, 0.0, 2.0), (0.0, 0.01, 100.0), (-15.0, 0.0, 15.0), (-1.0, 0.0, 1.0)
    grid = np.array(list(itertools.product(*values)))
    p = SimpleNamespace(**dict(zip(("alpha", "beta", "gamma", "d"), grid.T.copy(), strict=True)))
    rng = np.random.default_rng(6)
    inputs = (np.array([1.0, 1.0]), np.array([0.0, 1e3]), np.cumsum(rng.normal(size=50)), 1e-9 * rng.normal(size=50))
    for u in inputs:
        for coefficient in (0.0, 1e-9, 0.1, 1e9):
            coefficients = np.full(len(grid), coefficient)
            found = BoucWen(n)._dragged(read_only(np.arange(float(u.size))), read_only(u[:, None]), coefficients, p)
            assert np.all(np.isfinite(found))


@pytest.mark.parametrize("n", [1.0, 1.5])
@pytest.mark.parametrize("coefficient", [0.02, 0.2])
def test_bouc_wen_follows_a_tight_integration_of_its_implicit_law(coefficient, n):
    alpha, beta, gamma, d = LAWS["bouc-wen"][1].values()

    def slopes(t, state):
        z, h = state
        behind = np.sin(2 * np.pi * t) + 0.4 * np.sin(7 * np.pi * t) - z
        bend = alpha * d - (beta * np.sign(behind) * np.sign(h) + gamma) * abs(h) ** n  # dh/dz
        rise = behind / (coefficient * (d - bend))  # u - z = e dv/dt, dv = (d - dh/dz) dz
        return rise, bend * rise

    time, u = driven(8001)
    exact = solve_ivp(slopes, (0.0, 2.0), (0.0, 0.0), "LSODA", time, rtol=1e-10, atol=1e-12, max_step=1e-3)
    expected = d * exact.y[0] - exact.y[1]
    found = dragged("bouc-wen" if n == 1.0 else "bouc-wen, n = 1.5", time, u, coefficient)[:, 0]
    assert np.max(np.abs(found - plain("bouc-wen", u)[:, 0])) > 0.2
    np.testing.assert_allclose(found, expected, atol=2e-5)


@pytest.mark.parametrize("name", LAWS)
def test_the_law_without_drag_maps_what_acts_to_the_same_output(name):
    """z = u - e dy/dt in the middle of every step, from the output found, put into the kernel without."""
    time, u = driven(20001)
    for coefficient in (0.02, 0.2):
        y = dragged(name, time, u, coefficient)[:, 0]
        middle, found = 0.5 * (u[1:] + u[:-1]), 0.5 * (y[1:] + y[:-1])
        acting = middle - coefficient * np.diff(y) / np.diff(time)
        assert np.max(np.abs(acting - middle)) > 0.05
        assert np.max(np.abs(plain(name, acting)[:, 0] - found)) < 1e-5 * np.ptp(y)


@pytest.mark.parametrize("name", LAWS)
def test_it_converges_with_the_second_order_of_the_step(name):
    fine = dragged(name, *driven(64001), 0.05)[::256, 0]
    errors = [
        np.max(np.abs(dragged(name, *driven(samples), 0.05)[:: (samples - 1) // 250, 0] - fine))
        for samples in (251, 4001)
    ]
    assert errors[0] < 0.01 * np.ptp(fine)
    assert errors[1] < errors[0] / 3.0**4


def test_a_straight_law_is_an_exact_first_order_lag_on_any_grid():
    rng = np.random.default_rng(2)
    time = read_only(np.cumsum(rng.uniform(1e-3, 1.0, 60)))
    u = read_only(rng.normal(size=(60, 1)))
    coefficients = np.geomspace(1e-4, 1e3, 8)
    straight = {"alpha": 0.0, "beta": 1.0, "gamma": 0.5, "d": 1.3}
    p = SimpleNamespace(**{key: np.full(8, x) for key, x in straight.items()})
    found = BoucWen()._dragged(time, u, coefficients, p)
    np.testing.assert_allclose(found, 1.3 * lag(time, u, 1.3 * coefficients), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_a_coefficient_of_zero_is_the_kernel_without(name):
    for samples in (30, 400):
        time, u = driven(samples)
        np.testing.assert_allclose(dragged(name, time, u, 0.0), plain(name, u), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("model", "step"), [(JilesAtherton(), 500.0), (JilesAthertonClamped(), 500.0), (BoucWen(), 1.0)]
)
def test_so_it_is_all_over_the_box(model, step):
    rng = np.random.default_rng(8)
    H = step * np.cumsum(rng.normal(size=(80, 1)), axis=0)
    H[30:33] = H[30]
    H = read_only(H)
    drawn = Space(model.parameters).from_unit(rng.random((len(model.parameters), 200)))
    p = SimpleNamespace(**{q.name: row for q, row in zip(model.parameters, drawn, strict=True)})
    expected = model._plain(H, p)
    found = model._dragged(read_only(np.arange(80.0)), H, np.zeros(200), p)
    assert np.all(np.isfinite(found))
    # where the law has several branches, rounding alone decides between them
    same = np.max(np.abs(found - expected), axis=0) <= 1e-6 * np.ptp(expected, axis=0)
    assert np.mean(same) > 0.95


@pytest.mark.parametrize("name", LAWS)
def test_a_small_drag_is_small_and_a_large_one_holds_the_output(name):
    """|e (y - y(0))| is the integral of u - z, and z stays within the range of u."""
    time, u = driven(300)
    coefficients = 10.0 ** np.arange(-12, 13)
    y = dragged(name, time, u, *coefficients)
    assert np.all(np.isfinite(y))
    moved = np.max(np.abs(y - y[0]), axis=0)
    assert np.all(moved <= 1.001 * np.ptp(u) * (time[-1] - time[0]) / coefficients + 1e-12)
    assert np.max(np.abs(y - plain(name, u)), axis=0)[0] < 1e-6
    assert np.all(y <= 1.001 * np.max(plain(name, np.linspace(0.0, np.ptp(u), 300))))


@pytest.mark.parametrize("name", LAWS)
def test_loops_grow_with_frequency(name):
    """The work of the drag, e (dy/dt)^2, comes on top of the loop's own."""
    areas = []
    for frequency in (0.01, 0.1, 0.5):
        time = np.linspace(0.0, 3.0 / frequency, 6001)
        u = np.sin(2 * np.pi * frequency * time)
        y = dragged(name, time, u, 0.1)[4000:, 0]
        rate = np.gradient(y, time[4000:])
        areas.append(np.trapezoid(u[4000:], y))
        drag = 0.1 * np.trapezoid(rate**2, time[4000:])
        acting = np.trapezoid(u[4000:] - 0.1 * rate, y)
        np.testing.assert_allclose(areas[-1], acting + drag, rtol=1e-3)
    assert areas[0] < areas[1] < areas[2]
    assert areas[2] > 1.2 * areas[0]


@pytest.mark.parametrize("name", LAWS)
def test_particles_do_not_know_of_each_other(name):
    time, u = driven(200)
    coefficients = [0.3, 0.0, 1e-3, 5.0]
    together = dragged(name, time, u, *coefficients)
    own = dragged(name, time, np.repeat(u[:, None], 4, axis=1), *coefficients)
    assert np.array_equal(own, together)
    for j, coefficient in enumerate(coefficients):
        assert np.array_equal(dragged(name, time, u, coefficient)[:, 0], together[:, j])


def test_the_weight_of_the_end_is_smooth_and_right():
    weight = njit(lambda x: end_weight(x))
    assert weight(0.0) == 0.5
    assert weight(1e300) == weight(np.inf) == 1.0
    at = np.array([0.02, 0.1, 0.3, 0.49999, 0.5, 0.7, 3.0, 30.0])
    exact = 1.0 / (1.0 - np.exp(-at.astype(np.longdouble))) - 1.0 / at.astype(np.longdouble)
    np.testing.assert_allclose([weight(x) for x in at], exact.astype(float), rtol=4e-15)

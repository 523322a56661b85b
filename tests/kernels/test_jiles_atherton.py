"""The Jiles-Atherton kernel against a plain-Python twin, a tight ODE integration, and its own limits."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from hysteresis_bench.kernels import jiles_atherton as kernels
from hysteresis_bench.kernels.jiles_atherton import MU0
from hysteresis_bench.kernels.langevin import langevin_ratio
from hysteresis_bench.parameters import Space
from hysteresis_plugins.models.jiles_atherton import JilesAtherton
from tests.conftest import as_models_call

jiles_atherton = as_models_call(kernels.jiles_atherton, 0)

WELL_POSED = (
    (1e-6, 6.0, 10.0, 2.5e6, 0.2),
    (2e-6, 3.0, 12.0, 2.5e6, 0.5),  # c alpha M_s / 3a = 0.28, alpha M_s / k = 0.42
    (1e-14, 9.77, 33.8, 2.6e7, 1.94),  # Table 2, MPSO: c > 1
    (1e-14, 7.98, 58.1, 2.27e7, 1.55),  # Table 2, PSO
    (6e-5, 60.0, 70.0, 1e6, 1.0),  # c = 1, where (4) and (12) are singular
)


def drive(samples: int, peak: float = 60.0, cycles: float = 1.0) -> np.ndarray:
    """From 0 up, through both tips, and back."""
    return peak * np.sin(2 * np.pi * cycles * np.linspace(0.0, 1.0, samples))


def columns(*points: tuple[float, ...]) -> list[np.ndarray]:
    return [np.ascontiguousarray(row) for row in np.array(points, dtype=float).T]


def run(H: np.ndarray, *points: tuple[float, ...], clamped: bool = False) -> np.ndarray:
    return jiles_atherton(H.reshape(len(H), -1), *columns(*points), clamped)


def langevin(x: float) -> float:
    return 1.0 / math.tanh(x) - 1.0 / x if abs(x) > 0.05 else x / 3 - x**3 / 45 + 2 * x**5 / 945 - x**7 / 4725


def magnetization(H: float, Mi: float, p: tuple[float, ...]) -> float:
    """M from (11) with H_eff = H + alpha M, by bracketing: unique where the equation is well-posed."""
    alpha, a, _, M_s, c = p
    centre = (1 - c) * Mi

    def excess(M: float) -> float:
        return M - c * M_s * langevin((H + alpha * M) / a) - centre

    return brentq(excess, centre - c * M_s, centre + c * M_s, xtol=1e-9 * M_s, rtol=1e-14)


def ode_reference(H: np.ndarray, p: tuple[float, ...], clamped: bool) -> np.ndarray:
    """(5) integrated between the turning points to 1e-9, M implicit at every stage -> B."""
    alpha, a, k, M_s, _ = p
    turns = [0, *(np.nonzero(np.diff(np.sign(np.diff(H))))[0] + 1), len(H) - 1]
    Mi = np.zeros(len(H))
    for first, last in pairwise(turns):
        delta = math.copysign(1.0, H[last] - H[first])

        def slope(field: float, state: np.ndarray, delta: float = delta) -> list[float]:
            M = magnetization(field, state[0], p)
            D = M_s * langevin((field + alpha * M) / a) - state[0]
            return [0.0 if clamped and D * delta < 0 else D / (k * delta - alpha * D)]

        part = slice(first, last + 1)
        found = solve_ivp(
            slope, (H[first], H[last]), [Mi[first]], "DOP853", H[part], rtol=1e-9, atol=1e-9 * M_s, max_step=2.0
        )
        Mi[part] = found.y[0]
    return np.array([MU0 * (h + magnetization(h, m, p)) for h, m in zip(H, Mi, strict=True)])


def twin(H: np.ndarray, p: tuple[float, ...], clamped: bool) -> np.ndarray:
    """The kernel's scheme in plain Python with the exact Langevin function, M solved to the end."""
    alpha, a, k, M_s, c = p
    Mi, M, last, rise_D = 0.0, magnetization(H[0], 0.0, p), 0.0, 0.0
    Ma = M_s * langevin((H[0] + alpha * M) / a)
    B = [MU0 * (H[0] + M)]
    for before, field in pairwise(H):
        dH = field - before
        delta, h = math.copysign(1.0, dH), abs(dH)
        ahead = min(dH / last, 4.0) if dH * last > 0 else 0.0
        D = Ma - Mi
        kappa = k - alpha * delta * (D + ahead * rise_D / 2)
        kappa = max(kappa, 0.0) if clamped else kappa
        s = h / kappa
        decay = 1 / (1 + s + s * s / 2)
        follow = (s / 2 + s * s / 2) * decay

        def irreversible(
            Ma_next: float, delta: float = delta, D: float = D, Ma: float = Ma, Mi: float = Mi,
            decay: float = decay, follow: float = follow,
        ) -> float:  # fmt: skip
            if clamped and delta * D < 0:
                return Mi + follow * (Ma_next - Mi) if delta * (Ma_next - Mi) > 0 else Mi
            return Mi + (1 - decay) * D + follow * (Ma_next - Ma)

        def excess(trial: float, field: float = field, irreversible=irreversible) -> float:
            Ma_trial = M_s * langevin((field + alpha * trial) / a)
            return trial - c * Ma_trial - (1 - c) * irreversible(Ma_trial)

        M = brentq(excess, M - 4 * M_s, M + 4 * M_s, xtol=1e-9, rtol=1e-14)
        Ma = M_s * langevin((field + alpha * M) / a)
        Mi = irreversible(Ma)
        rise_D, last = Ma - Mi - D, dH
        B.append(MU0 * (field + M))
    return np.array(B)


def test_langevin_is_within_its_stated_error_everywhere() -> None:
    x = np.concatenate([[1e-300, 1e-9], np.linspace(1e-3, 14.0, 4001), np.geomspace(14.0, 1e12, 200)]).astype(
        np.longdouble
    )
    near = x < 0.3
    t = np.where(near, x, 0.0) ** 2
    series = 1 / np.longdouble(3) - t * (
        1 / np.longdouble(45)
        - t
        * (
            2 / np.longdouble(945)
            - t * (1 / np.longdouble(4725) - t * (2 / np.longdouble(93555) - t * 1382 / np.longdouble(638512875)))
        )
    )
    far = np.where(near, 1.0, x)
    exact = np.where(near, series, (1 / np.tanh(far) - 1 / far) / far)
    found = np.array([langevin_ratio(float(value)) for value in x])
    assert np.max(np.abs(found / exact - 1)) < 7e-10
    assert langevin_ratio(0.0) == pytest.approx(1 / 3, rel=7e-10)
    assert langevin_ratio(-2.0) == langevin_ratio(2.0)


@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("p", WELL_POSED)
def test_twin(p: tuple[float, ...], clamped: bool) -> None:
    H = drive(1500)
    expected = twin(H, p, clamped)
    assert run(H, p, clamped=clamped)[:, 0] == pytest.approx(expected, abs=1e-5 * np.ptp(expected))


@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("p", WELL_POSED)
def test_ode_and_order(p: tuple[float, ...], clamped: bool) -> None:
    """Below 1e-4 of the range at 6400 samples a cycle, and second order as the step is halved."""
    coarse = drive(801)
    exact = ode_reference(coarse, p, clamped)
    errors = []
    for refinement in (1, 2, 4, 8):
        found = run(drive(800 * refinement + 1), p, clamped=clamped)[::refinement, 0]
        errors.append(np.max(np.abs(found - exact)) / np.ptp(exact))
    assert errors[-1] < 1e-4
    order = np.log2(errors[0] / errors[2]) / 2
    assert order > 1.7 or errors[2] < 1e-7, errors


@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("scaling", ["linear", "log"])
def test_finite_and_deterministic_in_the_papers_box(scaling: str, clamped: bool) -> None:
    space = Space(tuple(q.within(q.lower, q.upper, scaling) for q in JilesAtherton.parameters))
    unit = np.random.default_rng(5).random((5, 2000))
    unit[:, :32] = np.array(np.meshgrid(*[[0.0, 1.0]] * 5)).reshape(5, 32)  # and every corner
    p = [np.ascontiguousarray(row) for row in space.from_unit(unit)]
    H = np.concatenate([drive(300, 60.0), drive(300, 5000.0), 30.0 - drive(100, 0.01)])[:, None]
    B = jiles_atherton(H, *p, clamped)
    assert np.all(np.isfinite(B))
    assert np.array_equal(B, jiles_atherton(H, *p, clamped))


@pytest.mark.parametrize("clamped", [False, True])
def test_place_and_neighbours_do_not_matter(clamped: bool) -> None:
    rng = np.random.default_rng(1)
    points = np.array(WELL_POSED[0]) * np.exp(rng.normal(0, 0.7, (21, 5)))
    H = drive(400)
    together = run(H, *points, clamped=clamped)
    order = rng.permutation(21)
    assert np.array_equal(run(H, *points[order], clamped=clamped), together[:, order])
    for j in (0, 7, 8, 20):
        assert np.array_equal(run(H, points[j], clamped=clamped)[:, 0], together[:, j])
    own = np.repeat(H[:, None], 21, axis=1)
    assert np.array_equal(run(own, *points, clamped=clamped), together)


@pytest.mark.parametrize("own", [False, True])
def test_repeated_samples_change_nothing(own: bool) -> None:
    H = drive(200)
    repeats = np.random.default_rng(3).integers(1, 4, 200)
    points = WELL_POSED[:3]
    once = run(H, *points)
    held = np.repeat(H, repeats)
    held = np.repeat(held[:, None], 3, axis=1) if own else held
    assert np.array_equal(run(held, *points), np.repeat(once, repeats, axis=0))


def test_starts_anywhere_with_irreversible_magnetization_zero() -> None:
    for H0 in (-60.0, -1e-3, 0.0, 3.0, 60.0):
        for p in WELL_POSED:
            assert run(np.array([H0, H0]), p)[0, 0] == pytest.approx(MU0 * (H0 + magnetization(H0, 0.0, p)), rel=1e-7)


def test_coarse_sampling_far_beyond_k_follows_the_anhysteretic_curve() -> None:
    """k = 0.01 with steps of 3: M_irr has no time to lag, and nothing rings."""
    p = (1e-7, 20.0, 0.01, 1e6, 0.2)
    H = drive(129)
    anhysteretic = np.array([magnetization(h, 0.0, (*p[:4], 1.0)) for h in H])
    expected = MU0 * (H + anhysteretic)
    assert run(H, p)[:, 0] == pytest.approx(expected, abs=1e-3 * np.ptp(expected))


def test_inputs_are_untouched() -> None:
    H, p = drive(50)[:, None], columns(*WELL_POSED)
    kept = [H.copy(), *(row.copy() for row in p)]
    jiles_atherton(H, *p)
    assert all(np.array_equal(now, before) for now, before in zip([H, *p], kept, strict=True))

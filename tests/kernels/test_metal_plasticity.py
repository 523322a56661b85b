"""The kernel of metal plasticity against its equations in tiny steps, and against elastic-perfectly plastic flow."""

import numpy as np
import pytest

from hysteresis_bench.kernels import metal_plasticity as kernels
from hysteresis_bench.kernels.metal_plasticity_step import flowed
from tests.conftest import as_models_call

metal_plasticity = as_models_call(kernels.metal_plasticity, 0)

PATH = np.interp(np.arange(0.0, 9.0, 0.03), np.arange(9), [0.0, 1.2, -0.8, 2.0, -2.0, 0.5, -1.0, 3.0, -3.0])
HARDENING = [0.4, 0.3, 0.5, 0.1, 3.0, 0.3, 2.0, 0.2, 0.4]
SOFTENING = [0.4, -0.1, 0.5, 0.15, 4.0, 0.3, 8.0, 0.0, 0.4]


def plain(u, p, parts=2000):
    """The equations as they are printed: small steps, each returned to the yield surface along its normal."""
    u_y, Q, b, D, a, S_1, gamma_1, S_2, gamma_2 = p
    stress = X_1 = X_2 = path = 0.0
    found = [0.0]
    for increment in np.diff(u).tolist():
        for _ in range(parts):
            stress += increment / parts
            size = u_y + Q * (1.0 - np.exp(-b * path)) - D * (1.0 - np.exp(-a * path))
            over = abs(stress - X_1 - X_2) - size
            if over > 0.0:
                s = np.sign(stress - X_1 - X_2)
                slope_1, slope_2 = gamma_1 * (S_1 * s - X_1), gamma_2 * (S_2 * s - X_2)
                harder = Q * b * np.exp(-b * path) - D * a * np.exp(-a * path)
                flow = over / (1.0 + s * (slope_1 + slope_2) + harder)
                stress, X_1, X_2, path = stress - s * flow, X_1 + slope_1 * flow, X_2 + slope_2 * flow, path + flow
        found.append(stress)
    return np.array(found)


@pytest.mark.parametrize("p", [HARDENING, SOFTENING], ids=["hardening", "softening"])
def test_it_is_its_equations(p):
    u = PATH[::10]
    found = metal_plasticity(u[:, None], np.array(p)[:, None])[:, 0]
    np.testing.assert_allclose(found, plain(u, p), atol=2e-3)


def test_it_does_not_depend_on_the_sampling():
    fine = np.interp(np.linspace(0.0, 1.0, 4 * PATH.size - 3), np.linspace(0.0, 1.0, PATH.size), PATH)
    p = np.array(HARDENING)[:, None]
    np.testing.assert_allclose(metal_plasticity(fine[:, None], p)[::4], metal_plasticity(PATH[:, None], p), atol=1e-11)


def test_without_hardening_it_is_perfectly_plastic():
    p = np.array([0.4, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0])[:, None]
    stress, expected = 0.0, [0.0]
    for step in np.diff(PATH):
        stress = min(max(stress + step, -0.4), 0.4)
        expected.append(stress)
    np.testing.assert_allclose(metal_plasticity(PATH[:, None], p)[:, 0], expected, atol=1e-12)


def test_a_swarm_is_its_particles_and_stays_bounded():
    rng = np.random.default_rng(0)
    p = np.array(HARDENING)[:, None] * np.exp(rng.normal(0.0, 1.0, (9, 40)))
    p[3] = 0.45 * p[0] * rng.random(40)
    p[1] = p[0] * rng.uniform(-0.5, 3.0, 40)
    found = metal_plasticity(PATH[:, None], p)
    assert np.all(np.abs(found) <= p[0] + np.maximum(p[1], 0.0) + p[5] + p[7] + 1e-9)
    own = np.repeat(PATH[:, None], 40, axis=1)
    assert np.array_equal(metal_plasticity(own, p), found)
    assert np.array_equal(metal_plasticity(PATH[:, None], np.ascontiguousarray(p[:, 7:8]))[:, 0], found[:, 7])


def metals(swarm):
    """Any parameters of a box around strains of 1, corners among them."""
    rng = np.random.default_rng(1)
    share = rng.random((9, swarm))
    share = np.where(rng.random((9, swarm)) < 0.4, np.round(share), share)
    low = np.array([1e-3, -0.5, 1e-2, 0.0, 1e-2, 0.0, 0.03, 0.0, 0.03])[:, None]
    high = np.array([1.0, 3.0, 1e3, 0.45, 1e3, 3.0, 1e4, 3.0, 1e4])[:, None]
    p = np.where(low > 0.0, np.abs(low) ** (1.0 - share) * high**share, low + share * (high - low))
    p[[1, 3, 5, 7]] *= p[0]
    return p


@pytest.mark.parametrize("swarm", [1, 8, 19, 100])
@pytest.mark.parametrize("parts", [0.05, 1.0, 30.0], ids=["coarse", "as is", "fine"])
def test_particles_side_by_side_make_the_step_of_one(swarm, parts):
    ends = PATH.size - 1
    u = np.interp(np.linspace(0.0, ends, round(parts * ends) + 1), np.arange(PATH.size), PATH)
    p = metals(swarm)
    found = metal_plasticity(u[:, None], p)
    for j in range(swarm):
        state, alone, one = np.zeros(4), [0.0], p[:, j].copy()
        for step in np.diff(u):
            alone.append(flowed(state, step, one))
        largest = np.max(np.abs(alone))
        np.testing.assert_allclose(found[:, j], alone, rtol=0.0, atol=1e-10 * max(largest, 0.1))
    part = slice(swarm // 3, swarm // 3 + 9)
    own = np.repeat(u[:, None], swarm, axis=1)
    few = np.ascontiguousarray(p[:, part])
    assert np.array_equal(metal_plasticity(u[:, None], few), found[:, part])
    assert np.array_equal(metal_plasticity(np.ascontiguousarray(own[:, part]), few), found[:, part])


def test_own_strains_are_told_apart():
    p = metals(19)
    own = PATH[:, None] * np.linspace(0.1, 2.0, 19)
    found = metal_plasticity(own, p)
    for j in (0, 7, 18):
        assert np.array_equal(metal_plasticity(own[:, j : j + 1], p[:, j : j + 1].copy())[:, 0], found[:, j])

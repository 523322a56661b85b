"""The kernel of metal plasticity against its equations in tiny steps, and against elastic-perfectly plastic flow."""

import numpy as np
import pytest

from hysteresis_bench.kernels import metal_plasticity as kernels
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

"""The generalized Bouc-Wen kernel against a plain integration with tiny steps, and against Bouc-Wen."""

import math

import numpy as np
import pytest

from hysteresis_bench.kernels import bouc_wen as plainer
from hysteresis_bench.kernels import bouc_wen_generalized as kernels
from hysteresis_bench.kernels.bouc_wen_generalized_step import strained
from tests.conftest import as_models_call

bouc_wen = as_models_call(plainer.bouc_wen, 0)
bouc_wen_generalized = as_models_call(kernels.bouc_wen_generalized, 0)

PATH = np.interp(np.arange(0.0, 9.0, 0.03), np.arange(9), [0.0, 1.2, -0.8, 2.0, -2.0, 0.5, -1.0, 3.0, -3.0])
PLAIN = [0.7, 1.0, 0.6, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0]
RICH = [0.7, 1.8, 0.6, 0.15, 0.05, 0.08, 0.6, 0.5, 0.2, 0.3]


def plain(u, p, parts=200):
    """The equations as they are printed, by Heun's rule on a fine path."""
    u_y, n, beta, phi, delta_nu, delta_eta, zeta, growth, q, width = p

    def rate(z, energy, s):
        nu, eta = 1.0 + delta_nu * energy, 1.0 + delta_eta * energy
        sign = math.copysign(1.0, z) if z else 0.0
        bound = (1.0 / (nu * (1.0 + 2.0 * phi * s))) ** (1.0 / n)
        h = 1.0 - zeta * (1.0 - math.exp(-growth * energy)) * math.exp(-(((z * s - q * bound) / width) ** 2))
        shape = beta * s * sign + 1.0 - beta + phi * (s + sign)
        return h * (1.0 - nu * abs(z) ** n * shape) / (eta * u_y)

    z, energy, found = 0.0, 0.0, [0.0]
    for increment in np.diff(u).tolist():
        du = increment / parts
        s = math.copysign(1.0, du)
        for _ in range(parts):
            first = rate(z, energy, s)
            second = rate(z + du * first, energy + z * du, s)
            new = z + 0.5 * du * (first + second)
            z, energy = new, energy + 0.5 * (z + new) * du
        found.append(z)
    return np.array(found)


@pytest.mark.parametrize("p", [PLAIN, RICH], ids=["plain", "rich"])
def test_it_is_its_equations(p):
    found = bouc_wen_generalized(PATH[:, None], np.array(p)[:, None])[:, 0]
    np.testing.assert_allclose(found, plain(PATH, p), atol=6e-4)


def test_without_its_additions_it_is_bouc_wen():
    found = bouc_wen_generalized(PATH[:, None], np.array(PLAIN)[:, None])
    one = np.ones(1)
    h = -bouc_wen(PATH[:, None], one, np.array([0.6 / 0.7]), np.array([0.4 / 0.7]), one) + PATH[:, None]
    np.testing.assert_allclose(found, h / 0.7, atol=1e-3)


@pytest.mark.parametrize("stretch", [0.1, 1.0, 30.0])
def test_particles_side_by_side_make_the_step_of_one(stretch):
    rng = np.random.default_rng(1)
    p = np.array(RICH)[:, None] * np.exp(rng.normal(0.0, 0.3, (10, 19)))
    p[1] = np.maximum(p[1], 1.0)
    p[1, :5] = 1.0
    p[3] = rng.uniform(-0.3, 0.3, 19)
    p[6, ::3] = 0.0
    found = bouc_wen_generalized(stretch * PATH[:, None], p)
    for j in range(19):
        z, energy, alone, own = 0.0, 0.0, [0.0], p[:, j].copy()
        for step in np.diff(stretch * PATH):
            z, energy = strained(z, energy, step, own)
            alone.append(z)
        np.testing.assert_allclose(found[:, j], alone, atol=1e-9)
    own = np.repeat(stretch * PATH[:, None], 3, axis=1)
    assert np.array_equal(bouc_wen_generalized(own, np.ascontiguousarray(p[:, 8:11])), found[:, 8:11])


def test_coarse_increments_and_steep_shapes_stay_bounded():
    rng = np.random.default_rng(0)
    swarm = 200
    p = np.array(RICH)[:, None] * np.ones(swarm)
    p[0] = 10.0 ** rng.uniform(-5, 1, swarm)
    p[1] = rng.uniform(1.0, 8.0, swarm)
    p[2] = rng.random(swarm)
    p[3] = rng.uniform(-0.4, 0.4, swarm)
    p[4:6] = rng.uniform(-0.02, 1.0, (2, swarm))
    z = bouc_wen_generalized(rng.normal(size=(300, 1)), p)
    assert np.all(np.abs(z) <= 1.0 / (0.02 * 0.2))


def test_strength_that_degrades_falls_from_cycle_to_cycle():
    u = np.tile(np.concatenate([np.linspace(0, 3, 50), np.linspace(3, -3, 100), np.linspace(-3, 0, 50)]), 4)
    p = np.array([0.5, 2.0, 0.5, 0.0, 0.05, 0.0, 0.0, 1.0, 0.0, 1.0])[:, None]
    peaks = bouc_wen_generalized(u[:, None], p).reshape(4, -1).max(axis=1)
    assert np.all(np.diff(peaks) < -0.02)

"""Friction kernels against plain loops with many small steps."""

import math

import numpy as np
import pytest

from hysteresis_bench.kernels.dahl import dahl, slipped
from hysteresis_bench.kernels.lugre import _excess, lugre
from hysteresis_bench.kernels.stop_bank import stop_bank

PATH = np.cumsum(np.random.default_rng(8).normal(size=200))


def refined(u, times):
    """The same path with more samples, (samples,), and where the given ones are."""
    fine = np.interp(np.arange((u.size - 1) * times + 1) / times, np.arange(u.size), u)
    return fine, slice(None, None, times)


def test_a_bank_is_the_sum_of_springs_that_slip():
    limits, stiffnesses = [0.4, 1.7], [2.0, -0.5]
    found = stop_bank(
        PATH[:, None], np.array([1.5]), np.array(limits)[:, None], np.array(stiffnesses)[:, None], np.zeros(1)
    )
    expected = 1.5 * PATH + np.array(stops(PATH, limits)) @ stiffnesses
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-12, atol=1e-12)


def stops(u, limits):
    strain, found = [0.0] * len(limits), []
    for step in np.diff(u, prepend=u[0]).tolist():
        strain = [max(-r, min(r, e + step)) for r, e in zip(limits, strain, strict=True)]
        found.append(strain)
    return found


def test_an_element_crosses_its_clearance_without_force():
    u = np.array([0.0, 0.2, 1.0, 2.0, 1.9, 1.6, 1.5, 1.2, 1.1, 0.5])
    force = stop_bank(u[:, None], np.zeros(1), np.array([[0.4]]), np.array([[10.0]]), np.array([0.2]))[:, 0]
    # engages at 0.2, slips from 0.6; back: slack from 1.6 to 1.2, then the other side
    np.testing.assert_allclose(force, [0.0, 0.0, 4.0, 4.0, 3.0, 0.0, 0.0, 0.0, -1.0, -4.0], atol=1e-12)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.7])
def test_dahl_is_its_equation(exponent):
    u, given = refined(PATH, 400)
    z, expected = 0.0, [0.0]
    for step in np.diff(u).tolist():
        s = math.copysign(1.0, step)
        slope = max(1.0 - s * z, 0.0) ** exponent / 0.9
        middle = max(1.0 - s * (z + 0.5 * step * slope), 0.0) ** exponent / 0.9
        z = max(-1.0, min(1.0, z + step * middle))
        expected.append(z)
    found = dahl(PATH[:, None], np.array([0.9]), np.array([exponent]), np.zeros(1))
    np.testing.assert_allclose(found[:, 0], np.array(expected)[given], atol=2e-5)


def test_dahl_does_not_depend_on_the_sampling():
    u, given = refined(PATH, 7)
    parameters = np.array([0.3]), np.array([0.7]), np.array([0.5])
    np.testing.assert_allclose(dahl(u[:, None], *parameters)[given], dahl(PATH[:, None], *parameters), atol=1e-12)


def test_dahl_crosses_its_clearance_without_force():
    u = np.concatenate([np.linspace(0.0, 5.0, 500), np.linspace(5.0, 0.0, 500)])
    z = dahl(u[:, None], np.array([0.2]), np.array([0.5]), np.array([0.6]))[:, 0]
    back = u[500:][z[500:] == 0.0]
    assert back.max() - back.min() == pytest.approx(1.2, abs=0.03)
    assert z.max() == 1.0
    assert z.min() == -1.0


def swarm_of_dahl(rng, swarm):
    """distance, i and gap at the edges of a box and inside it."""
    distance = 2e-3 * 1e3 ** rng.choice([0.0, 0.5, 1.0], swarm)
    exponent = rng.choice([0.0, 0.1, 0.7, 1.0, 1.0 + 1e-3, 1.6, 3.0], swarm)
    return distance, exponent, rng.choice([0.0, 0.05, 0.5], swarm)


@pytest.mark.parametrize("swarm", [1, 8, 19])
@pytest.mark.parametrize("stretch", [0.01, 0.3, 3.0])
def test_dahls_particles_side_by_side_make_the_step_of_one(swarm, stretch):
    rng = np.random.default_rng(swarm)
    p = swarm_of_dahl(rng, swarm)
    fine, _ = refined(stretch * PATH, 7)
    own = stretch * PATH[:, None] * rng.uniform(0.5, 1.5, swarm)
    for u in (stretch * PATH[:, None], fine[:, None], own, np.round(own, 1)):
        found = dahl(u, *p)
        for j in range(swarm):
            z, place, alone = 0.0, 0.0, [0.0]
            for step in np.diff(u[:, j if u.shape[1] > 1 else 0]).tolist():
                z, place = slipped(z, place, step, *(float(row[j]) for row in p))
                alone.append(z)
            # for one particle, 1 - i of 1e-3 makes a thousand roundings of every one
            np.testing.assert_allclose(found[:, j], alone, rtol=0.0, atol=1e-11 if abs(p[1][j] - 1.0) < 0.1 else 1e-12)


def test_a_particle_of_dahls_does_not_know_of_the_others():
    rng = np.random.default_rng(4)
    p = swarm_of_dahl(rng, 19)
    u = PATH[:, None] * rng.uniform(0.5, 1.5, 19)
    some = dahl(np.ascontiguousarray(u[:, 5:11]), *(row[5:11] for row in p))
    assert np.array_equal(some, dahl(u, *p)[:, 5:11])


def test_lugre_is_its_equation():
    u, given = refined(0.3 * PATH, 300)
    step = 0.01 / 300
    z, expected = 0.0, [0.0]
    for du in np.diff(u).tolist():
        v = du / step
        r = 1.0 + 0.6 * math.exp(-((v / 20.0) ** 2))
        z += step * (v - abs(v) * (z + 0.5 * step * (v - abs(v) * z / r) / 0.5) / r) / 0.5
        expected.append(z)
    time = 0.01 * np.arange(PATH.size)
    found, bending, v = lugre(time, True, 0.3 * PATH[:, None], np.array([0.5]), np.array([1.6]), np.array([20.0]))
    np.testing.assert_allclose(found[:, 0], np.array(expected)[given], atol=2e-5)
    np.testing.assert_allclose(v[1:-1, 0], 0.3 * (PATH[2:] - PATH[:-2]) / 0.02, rtol=1e-9)
    r = 1.0 + 0.6 * np.exp(-((v / 20.0) ** 2))
    np.testing.assert_allclose(bending, v - np.abs(v) * found / r, atol=1e-9)


def test_lugre_without_a_clock_is_dahl():
    found, bending, v = lugre(np.arange(200.0), False, PATH[:, None], np.array([0.5]), np.array([1.6]), np.array([1.0]))
    np.testing.assert_allclose(found, dahl(PATH[:, None], np.array([0.5]), np.ones(1), np.zeros(1)), atol=1e-12)
    assert not np.any(bending)
    assert not np.any(v)


def swarm_of_lugre(rng, swarm):
    """distance, stiction and v_s at the edges of a box and inside it."""
    distance, slowest = 2e-3 * 1e3 ** rng.choice([0.0, 0.5, 1.0], swarm), 1e-2 * 1e4 ** rng.choice([0.0, 0.5], swarm)
    return distance, rng.choice([0.1, 1.0, 1.6, 3.0], swarm), slowest


@pytest.mark.parametrize("swarm", [1, 8, 19])
@pytest.mark.parametrize("timed", [True, False])
@pytest.mark.parametrize("stretch", [0.01, 1.0])
def test_lugres_particles_side_by_side_make_the_step_of_one(swarm, timed, stretch):
    rng = np.random.default_rng(swarm)
    p = swarm_of_lugre(rng, swarm)
    time = np.cumsum(rng.uniform(0.1, 1.0, PATH.size))
    own = stretch * PATH[:, None] * rng.uniform(0.5, 1.5, swarm)
    for u in (stretch * PATH[:, None], own, np.round(own, 1)):
        found, bending, v = lugre(time, timed, u, *p)
        for j in range(swarm):
            distance, stiction, slowest = (float(row[j]) for row in p)
            column = u[:, j if u.shape[1] > 1 else 0]
            z, alone = 0.0, [0.0]
            for step, wait in zip(np.diff(column).tolist(), np.diff(time).tolist(), strict=True):
                r = _excess.py_func(stiction, step / wait, slowest) if timed else 1.0
                end = math.copysign(r, step)
                z = end + (z - end) * math.exp(-abs(step) / (r * distance))
                alone.append(z)
            np.testing.assert_allclose(found[:, j], alone, rtol=0.0, atol=1e-13)
            if timed:
                now = (column[2:] - column[:-2]) / (time[2:] - time[:-2])
                r = np.array([_excess.py_func(stiction, one, slowest) for one in now.tolist()])
                np.testing.assert_allclose(v[1:-1, j], now, rtol=1e-14, atol=0.0)
                told = now - np.abs(now) * found[1:-1, j] / r
                np.testing.assert_allclose(bending[1:-1, j], told, rtol=0.0, atol=1e-12 * max(np.abs(now)))


def test_a_particle_of_lugres_does_not_know_of_the_others():
    rng = np.random.default_rng(4)
    p = swarm_of_lugre(rng, 19)
    time, u = np.arange(200.0), PATH[:, None] * rng.uniform(0.5, 1.5, 19)
    some = lugre(time, True, np.ascontiguousarray(u[:, 5:11]), *(row[5:11] for row in p))
    for few, all_of_them in zip(some, lugre(time, True, u, *p), strict=True):
        assert np.array_equal(few, all_of_them[:, 5:11])

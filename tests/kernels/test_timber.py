"""The kernel of timber joints against a plain twin, and against what its source says of its paths."""

from itertools import pairwise

import numpy as np
import pytest

from hysteresis_bench.kernels.timber import timber
from hysteresis_bench.kernels.timber_step import followed

PATH = np.interp(np.arange(0.0, 9.0, 0.03), np.arange(9), [0.0, 1.2, -0.8, 2.0, -2.0, 0.5, -1.0, 3.0, -3.0])
JOINT = np.array([0.3, 0.05, 1.5, 0.1, 0.2, 0.7, 1.1])[:, None]


def plain(u, u_y, r_1, r_3, f_I, r_4, alpha, beta):
    """Half cycle by half cycle."""

    def envelope(x):
        return (1.0 + r_1 * x) * (1.0 - np.exp(-x))

    x = (u - u[0]) / u_y
    f, way, furthest = 0.0, 0, {1: 0.0, -1: 0.0}
    found = [0.0]
    for old, new in pairwise(x):
        s = 1 if new > old else -1
        if way == -s:
            furthest[way] = max(furthest[way], way * old)
        way = s
        end, top = beta * furthest[s], max(furthest.values())
        K, soft = (max(X, 1.0) ** -alpha for X in (furthest[s], top))
        if s * new >= end:
            bound = envelope(s * new)
        else:
            back = min(envelope(end) + K * (s * new - end), envelope(max(s * new, 0.0)))
            bound = max(f_I + r_4 * soft * s * new, back)
        f = s * min(s * f + r_3 * abs(new - old), max(bound, s * f))
        found.append(f)
    return np.array(found)


def test_it_is_its_twin():
    rng = np.random.default_rng(0)
    spread = JOINT * np.exp(rng.normal(0.0, 0.3, (7, 20)))
    spread[6] = np.maximum(spread[6], 1.0)
    found = timber(PATH[:, None], spread)
    for j in range(20):
        np.testing.assert_allclose(found[:, j], plain(PATH, *spread[:, j]), atol=1e-12)
    assert np.array_equal(timber(np.repeat(PATH[:, None], 20, axis=1), spread), found)


def test_it_first_follows_the_envelope():
    u = np.linspace(0.0, 2.0, 50)
    x = u / 0.3
    np.testing.assert_allclose(timber(u[:, None], JOINT)[:, 0], (1.0 + 0.05 * x) * (1.0 - np.exp(-x)), atol=1e-12)


def test_a_second_cycle_of_the_same_amplitude_is_weaker_until_it_goes_further():
    u = np.interp(np.arange(0.0, 5.0, 0.01), [0, 1, 2, 3, 4, 5], [0.0, 1.0, -1.0, 1.0, -1.0, 1.5])
    f = timber(u[:, None], JOINT)[:, 0]
    assert f[300] < 0.95 * f[100]
    x = 1.5 / 0.3
    last = timber(np.append(u, 1.5)[:, None], JOINT)[-1, 0]
    np.testing.assert_allclose(last, (1.0 + 0.05 * x) * (1.0 - np.exp(-x)), rtol=1e-2)


def test_no_force_changes_faster_than_by_unloading():
    f = timber(PATH[:, None], JOINT)[:, 0]
    assert np.all(np.abs(np.diff(f)) <= 1.5 * np.abs(np.diff(PATH)) / 0.3 + 1e-12)


def joints(swarm):
    """Any parameters of a box around displacements of 3, corners among them."""
    rng = np.random.default_rng(2)
    share = rng.random((7, swarm))
    share = np.where(rng.random((7, swarm)) < 0.4, np.round(share), share)
    low = np.array([3e-3, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0])[:, None]
    high = np.array([6.0, 0.5, 30.0, 1.0, 1.0, 1.5, 1.5])[:, None]
    p = low + share * (high - low)
    p[[0, 2]] = (low * (high / np.maximum(low, 1e-9)) ** share)[[0, 2]]
    return p


def alone(u, p):
    """Increment by increment, one joint."""
    x = f = above = below = rising = 0.0
    found = [0.0]
    for new in ((u[1:] - u[0]) / p[0]).tolist():
        if new > x:
            below = max(below, -x) if rising < 0.0 else below
            rising, f = 1.0, followed(f, new, new - x, above, max(above, below), p)
        elif new < x:
            above = max(above, x) if rising > 0.0 else above
            rising, f = -1.0, -followed(-f, -new, x - new, below, max(above, below), p)
        x = new
        found.append(f)
    return np.array(found)


RANDOM = np.random.default_rng(3).normal(size=200)
PATHS = {
    "coarse": PATH[::17],
    "as is": PATH,
    "fine": np.interp(np.linspace(0.0, 299.0, 4000), np.arange(300), PATH),
    "with rests": np.repeat(PATH, 2),
    "as far again and again": 1.0 + np.sin(np.arange(300) * 0.25 * np.pi),
    "noise": RANDOM,
    "noise around a drift": np.cumsum(RANDOM) + RANDOM[::-1],
}


@pytest.mark.parametrize("swarm", [1, 8, 19, 60])
@pytest.mark.parametrize("path", PATHS)
def test_particles_side_by_side_make_the_step_of_one(path, swarm):
    u, p = PATHS[path], joints(swarm)
    found = timber(u[:, None], p)
    for j in range(swarm):
        expected = alone(u, p[:, j].copy())
        np.testing.assert_allclose(found[:, j], expected, rtol=0.0, atol=1e-12 * np.max(np.abs(expected)) + 1e-14)
    part = slice(swarm // 3, swarm // 3 + 9)
    few, own = np.ascontiguousarray(p[:, part]), np.repeat(u[:, None], swarm, axis=1)
    assert np.array_equal(timber(u[:, None], few), found[:, part])
    assert np.array_equal(timber(np.ascontiguousarray(own[:, part]), few), found[:, part])


def test_own_displacements_are_told_apart():
    p = joints(19)
    own = PATH[:, None] * np.linspace(-1.0, 2.0, 19) + 0.1 * RANDOM[np.arange(19) * np.arange(PATH.size)[:, None] % 200]
    found = timber(own, p)
    for j in range(19):
        assert np.array_equal(timber(own[:, j : j + 1].copy(), p[:, j : j + 1].copy())[:, 0], found[:, j])
        np.testing.assert_allclose(
            found[:, j], alone(own[:, j], p[:, j].copy()), rtol=0.0, atol=1e-12 * np.ptp(found[:, j])
        )

"""The kernel of worn joints against a plain twin, and against what it says of its paths."""

from itertools import pairwise

import numpy as np
import pytest

from hysteresis_bench.kernels.pinching import pinching
from hysteresis_bench.kernels.pinching_step import pinched

TURNS = [0.0, 1.2, -0.8, 2.0, -2.0, 0.5, -1.0, 3.0, -3.0]
PATH = np.interp(np.arange(0.0, 8.01, 0.03), np.arange(9), TURNS)
JOINT = np.array([0.3, 0.08, 0.05, 0.4, 0.7, 1.1, 0.08, 0.3])[:, None]


def envelope(x, r_1):
    return (1.0 + r_1 * x) * (1.0 - np.exp(-x))


def plain(u, u_y, r_1, f_I, gamma, r_4, beta, rho, corner):
    """Half cycle by half cycle."""
    x = (u - u[0]) / u_y
    f, direction, furthest = 0.0, 0, {1: 0.0, -1: 0.0}

    def way(at, s, least=0.0):
        M, end = max(least, *furthest.values()), beta * furthest[s]
        if at >= end:
            return envelope(at, r_1)
        g, h, top = max(M, 1.0) ** gamma, r_4 / (1.0 + beta * M), envelope(end, r_1)
        p, d = (min(f_I * g, top - h * end) + h * one for one in (at, end))
        d = top - d
        c = min(corner * g, 2.0 * d)
        b = (d - c**2 / (4.0 * d) if d > 0.0 else 0.0) + (1.0 - h) * (at - end)
        return p + 0.5 * (b + np.hypot(b, c))

    found = [0.0]
    for old, new in pairwise(x):
        s = 1 if new > old else -1
        if direction == -s:
            furthest[direction] = max(furthest[direction], direction * old)
        direction = s
        left = (way(s * old, s) - s * f) * np.exp(-abs(new - old) / (rho * max(1.0, *furthest.values())))
        led, (before, back) = way(s * new, s) - left, (-way(-s * at, -s, s * at) for at in (old, new))
        f = s * (max(led, back) if s * f >= before else led)
        found.append(f)
    return np.array(found)


def test_it_is_its_twin():
    rng = np.random.default_rng(0)
    spread = JOINT * np.exp(rng.normal(0.0, 0.3, (8, 20)))
    spread[4], spread[5] = np.minimum(spread[4], 1.0), np.maximum(spread[5], 1.0)
    found = pinching(PATH[:, None], spread)
    for j in range(20):
        np.testing.assert_allclose(found[:, j], plain(PATH, *spread[:, j]), atol=1e-12)
    assert np.array_equal(pinching(np.repeat(PATH[:, None], 20, axis=1), spread), found)


def test_it_first_follows_the_envelope():
    u = np.linspace(0.0, 2.0, 50)
    np.testing.assert_allclose(pinching(u[:, None], JOINT)[:, 0], envelope(u / 0.3, 0.08), atol=1e-12)


def test_few_samples_make_no_difference():
    few, many = np.array(TURNS), np.interp(np.arange(0.0, 8.001, 0.01), np.arange(9), TURNS)
    found = [pinching(u[:, None], JOINT)[:, 0] for u in (few, many)]
    np.testing.assert_allclose(found[0], found[1][::100], atol=1e-12)


def test_no_force_jumps():
    fine = np.interp(np.arange(0.0, 8.0, 1e-4), np.arange(9), TURNS)
    f = pinching(fine[:, None], JOINT)[:, 0]
    steps = np.abs(np.diff(f)) / np.abs(np.diff(fine))
    assert np.max(steps) < 20.0 / 0.3  # unloading over 0.08 of 1.2 at least, from a force of 2


def test_a_second_cycle_of_the_same_amplitude_is_weaker_and_pinched():
    u = np.interp(np.arange(0.0, 5.0, 0.01), np.arange(6), [0.0, 1.0, -1.0, 1.0, -1.0, 1.5])
    f = pinching(u[:, None], JOINT)[:, 0]
    assert f[300] < 0.95 * f[100]
    half, first = (np.argmin(np.abs(u[part] - 0.5)) + part.start for part in (slice(200, 300), slice(0, 100)))
    assert f[half] < 0.6 * f[first]
    last = pinching(np.append(u, 1.5)[:, None], JOINT)[-1, 0]
    np.testing.assert_allclose(last, envelope(1.5 / 0.3, 0.08), rtol=2e-2)


def joints(swarm):
    """Any parameters of a box around displacements of 3, corners among them."""
    rng = np.random.default_rng(2)
    share = rng.random((8, swarm))
    share = np.where(rng.random((8, swarm)) < 0.4, np.round(share), share)
    low = np.array([3e-3, 0.0, 0.0, 0.0, 0.0, 1.0, 0.005, 0.0])[:, None]
    high = np.array([6.0, 0.5, 0.5, 1.2, 1.0, 1.5, 0.2, 1.0])[:, None]
    p = low + share * (high - low)
    p[[0, 6]] = (low * (high / np.maximum(low, 1e-9)) ** share)[[0, 6]]
    return p


def alone(u, p):
    """Increment by increment, one joint."""
    x = f = above = below = rising = 0.0
    found = [0.0]
    for new in ((u[1:] - u[0]) / p[0]).tolist():
        if new > x:
            below = max(below, -x) if rising < 0.0 else below
            rising, f = 1.0, pinched(f, x, new, above, below, p)
        elif new < x:
            above = max(above, x) if rising > 0.0 else above
            rising, f = -1.0, -pinched(-f, -x, -new, below, above, p)
        x = new
        found.append(f)
    return np.array(found)


RANDOM = np.random.default_rng(3).normal(size=200)
PATHS = {
    "coarse": PATH[::17],
    "as is": PATH,
    "fine": np.interp(np.linspace(0.0, 8.0, 4000), np.arange(9), TURNS),
    "with rests": np.repeat(PATH, 2),
    "as far again and again": 1.0 + np.sin(np.arange(300) * 0.25 * np.pi),
    "noise": RANDOM,
    "noise around a drift": np.cumsum(RANDOM) + RANDOM[::-1],
}


@pytest.mark.parametrize("swarm", [1, 8, 19, 60])
@pytest.mark.parametrize("path", PATHS)
def test_particles_side_by_side_make_the_step_of_one(path, swarm):
    u, p = PATHS[path], joints(swarm)
    found = pinching(u[:, None], p)
    for j in range(swarm):
        expected = alone(u, p[:, j].copy())
        np.testing.assert_allclose(found[:, j], expected, rtol=0.0, atol=1e-12 * np.max(np.abs(expected)) + 1e-14)
    part = slice(swarm // 3, swarm // 3 + 9)
    few, own = np.ascontiguousarray(p[:, part]), np.repeat(u[:, None], swarm, axis=1)
    assert np.array_equal(pinching(u[:, None], few), found[:, part])
    assert np.array_equal(pinching(np.ascontiguousarray(own[:, part]), few), found[:, part])


def test_own_displacements_are_told_apart():
    p = joints(19)
    own = PATH[:, None] * np.linspace(-1.0, 2.0, 19) + 0.1 * RANDOM[np.arange(19) * np.arange(PATH.size)[:, None] % 200]
    found = pinching(own, p)
    for j in range(19):
        assert np.array_equal(pinching(own[:, j : j + 1].copy(), p[:, j : j + 1].copy())[:, 0], found[:, j])
        np.testing.assert_allclose(
            found[:, j], alone(own[:, j], p[:, j].copy()), rtol=0.0, atol=1e-12 * np.ptp(found[:, j])
        )

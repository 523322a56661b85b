"""The energy-based kernel against a plain solution of its equations by bracketing."""

import numpy as np
import pytest
from numba import njit
from scipy.optimize import brentq

from hysteresis_bench.kernels.energy_based import energy_based
from hysteresis_bench.kernels.langevin import langevin_ratio
from hysteresis_bench.kernels.play import played

PATH = 3.0 * np.cumsum(np.random.default_rng(3).normal(size=150)) / 4.0
PINNING, SHARES = [0.0, 0.4, 1.1], [0.3, 0.5, 0.2]


def langevin(x):
    return 1.0 / np.tanh(x) - 1.0 / x if abs(x) > 1e-3 else x / 3.0


@pytest.mark.parametrize("coupling", [0.0, 0.6, 0.95])
def test_it_is_its_equations(coupling):
    a = 0.7
    places, expected = [0.0] * 3, []
    for i, field in enumerate(PATH.tolist()):
        widths = PINNING if i else [0.0] * 3

        def moved(m, field=field, widths=widths, places=tuple(places)):
            h = field + 3.0 * a * coupling * m
            return [max(h - k, min(h + k, p)) for k, p in zip(widths, places, strict=True)]

        def excess(m, moved=moved):
            return sum(s * langevin(p / a) for s, p in zip(SHARES, moved(m), strict=True)) - m

        m = brentq(excess, -1.0, 1.0, xtol=1e-14)
        places = moved(m)
        expected.append(m)
    found = energy_based(
        PATH[:, None], np.array([a]), np.array([coupling]), np.array(PINNING)[:, None], np.array(SHARES)[:, None]
    )
    np.testing.assert_allclose(found[:, 0], expected, atol=2e-7)  # the Langevin kernel has 7e-10 relative


def test_without_pinning_there_is_no_loop():
    u = 5.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 401))
    one = np.ones(1)
    m = energy_based(u[:, None], one, 0.9 * one, np.zeros((1, 1)), np.ones((1, 1)))[:, 0]
    np.testing.assert_allclose(m[:201], m[200:], atol=1e-9)
    rising, falling = m[:51], m[50:101]
    np.testing.assert_allclose(rising, falling[::-1], atol=1e-9)


def test_a_closed_loop_dissipates():
    u = 5.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 801))
    one = np.ones(1)
    m = energy_based(u[:, None], one, 0.5 * one, np.array([[0.8]]), np.ones((1, 1)))[400:, 0]
    u = u[400:]
    lost = np.sum(0.5 * (u[1:] + u[:-1]) * np.diff(m))
    assert lost > 0.0
    # the plays lose the pinning times their path, which for one cell is the change of m: |dm| 0.8
    assert lost == pytest.approx(0.8 * np.sum(np.abs(np.diff(m))), rel=1e-2)


@njit
def halved(u, a, coupling, pinning, shares):
    """m of one particle by halving, with the kernel's Langevin function."""
    out, places, free = np.zeros(u.size), np.zeros(shares.size), np.zeros(shares.size)
    for i in range(u.size):
        widths = pinning if i else free
        low, high = -1.0, 1.0
        for _ in range(60):
            m = 0.5 * (low + high)
            found = 0.0
            for k in range(shares.size):
                x = played(u[i] + 3.0 * a * coupling * m, widths[k], places[k]) / a
                found += shares[k] * x * langevin_ratio(x)
            if found > m:
                low = m
            else:
                high = m
        for k in range(shares.size):
            places[k] = played(u[i] + 3.0 * a * coupling * m, widths[k], places[k])
        out[i] = m
    return out


def swarm_at_the_corners(rng, swarm, cells=6):
    """a, coupling, pinning, shares at the edges of a box and inside it."""
    a, median, spread = (np.exp(rng.choice([0.0, 0.4, 1.0], swarm) * np.log(r)) for r in (200.0, 500.0, 100.0))
    coupling = rng.choice([0.0, 0.5, 0.98], swarm)
    reversible = rng.choice([0.0, 0.3, 0.95], swarm)
    pinning = 2e-3 * median * np.exp(0.02 * spread * np.linspace(-1.6, 1.6, cells)[:, None])
    shares = np.repeat((1.0 - reversible)[None] / cells, cells, axis=0)
    return 0.01 * a, coupling, np.concatenate([np.zeros((1, swarm)), pinning]), np.concatenate([[reversible], shares])


@pytest.mark.parametrize("swarm", [1, 8, 19])
@pytest.mark.parametrize("stretch", [0.003, 0.3, 3.0])
def test_particles_side_by_side_find_what_halving_finds(swarm, stretch):
    rng = np.random.default_rng(swarm)
    p = swarm_at_the_corners(rng, swarm)
    fine = np.interp(np.arange(0.0, 149.0, 0.31), np.arange(150), stretch * PATH)[:, None]
    own = fine * rng.uniform(0.5, 1.5, swarm) + 0.01 * rng.normal(size=(fine.size, swarm))
    for u in (stretch * PATH[:, None], fine, own):
        found = energy_based(u, *p)
        for j in range(swarm):
            column = np.ascontiguousarray(u[:, j if u.shape[1] > 1 else 0])
            one = p[0][j], p[1][j], *(np.ascontiguousarray(rows[:, j]) for rows in p[2:])
            np.testing.assert_allclose(found[:, j], halved(column, *one), rtol=0.0, atol=5e-12)


def test_a_particle_does_not_know_of_the_others():
    rng = np.random.default_rng(4)
    p = swarm_at_the_corners(rng, 19)
    u = 0.3 * PATH[:, None] * rng.uniform(0.5, 1.5, 19)
    found = energy_based(u, *p)
    some = energy_based(np.ascontiguousarray(u[:, 5:11]), *(np.ascontiguousarray(rows[..., 5:11]) for rows in p))
    assert np.array_equal(some, found[:, 5:11])

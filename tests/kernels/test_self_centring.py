"""The self-centring kernel against its formula."""

import numpy as np
import pytest

from hysteresis_bench.kernels.self_centring import self_centring


def forces(u, z, parameters):
    """F, from the power that is below 1."""
    centre, bend, m, up, down, corner, strength, loss, q = parameters
    way = u - centre
    size = np.abs(way / bend)
    power = np.minimum(size, 1.0 / np.maximum(size, 1e-300)) ** m
    bent = np.sign(way) * np.minimum(size, 1.0) / (1.0 + power) ** (1.0 / m)
    above, below = (np.maximum.accumulate(np.maximum(side * way / bend, 0.0)) for side in (1.0, -1.0))
    corner = corner - loss * np.where(way >= 0.0, above, below) ** q
    return up * np.maximum(way, 0.0) + down * np.minimum(way, 0.0) + corner * bent + strength * z


def swarm_at_the_corners(rng, swarm):
    """centre, bend, m, up, down, corner, strength, loss and q at the edges of a box and inside it."""
    bend, m = 2e-3 * 1e3 ** rng.choice([0.0, 0.5, 1.0], swarm), rng.choice([0.5, 3.0, 20.0], swarm)
    centre = rng.choice([-0.2, 0.0, 0.1], swarm)
    forces, strengths = rng.choice([-5.0, 0.0, 1.0, 5.0], (3, swarm)), rng.choice([0.0, 5.0], (2, swarm))
    return np.stack([centre, bend, m, *forces, *strengths, rng.choice([0.1, 1.0, 3.0], swarm)])


@pytest.mark.parametrize("swarm", [1, 8, 19])
@pytest.mark.parametrize("columns", [1, None])
def test_it_is_its_formula(swarm, columns):
    rng = np.random.default_rng(swarm)
    p = swarm_at_the_corners(rng, swarm)
    z = rng.uniform(-1.0, 1.0, (400, swarm))
    u = rng.normal(size=(400, columns or swarm)) * 10.0 ** rng.integers(-6, 3, (400, 1))
    u[:9] = 0.0
    found = z.copy()
    self_centring(u, found, p)
    np.testing.assert_allclose(found, forces(u, z, p), rtol=1e-13, atol=1e-13)


def test_a_particle_does_not_know_of_the_others():
    rng = np.random.default_rng(4)
    p, u, z = swarm_at_the_corners(rng, 19), rng.normal(size=(50, 1)), rng.uniform(-1.0, 1.0, (50, 19))
    some = np.ascontiguousarray(z[:, 5:11])
    self_centring(u, some, np.ascontiguousarray(p[:, 5:11]))
    self_centring(u, z, p)
    assert np.array_equal(some, z[:, 5:11])

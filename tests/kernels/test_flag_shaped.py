"""The flag-shaped kernel against its plain twin, and what its loop promises."""

import numpy as np
import pytest

from hysteresis_bench.kernels.flag_shaped import flag_shaped


def forces(u, parameters):
    """F of one particle, sample by sample."""
    centre, bend, back, m, up, down, slope = parameters
    found, before, x = [], 0.0, 0.0

    def level(way, corner):
        return corner * (way / corner) / (1.0 + (way / corner) ** m) ** (1.0 / m) if corner > 0.0 else 0.0

    for now in u - centre:
        if now * before < 0.0:
            before = x = 0.0
        free = x + abs(now) - abs(before)
        x = max(min(free, level(abs(now), bend)), level(abs(now), back * bend))
        before = now
        found.append((up * x if now >= 0.0 else -down * x) + slope * now)
    return np.array(found)


def swarm_at_the_corners(rng, swarm):
    """centre, bend, return, m, up, down and slope at the edges of a box and inside it."""
    bend, back, m = (
        rng.choice([0.05, 0.3, 2.0], swarm),
        rng.choice([0.0, 0.4, 1.0], swarm),
        rng.choice([1, 5, 60], swarm),
    )
    return np.stack([rng.choice([-0.2, 0.0, 0.1], swarm), bend, back, m, *rng.choice([0.0, 1.0, 5.0], (3, swarm))])


def simulated(u, parameters):
    force = np.empty((u.shape[0], parameters.shape[1]))
    flag_shaped(u, parameters, force)
    return force


@pytest.mark.parametrize("swarm", [1, 8, 19])
@pytest.mark.parametrize("columns", [1, None])
def test_it_is_its_twin(swarm, columns):
    rng = np.random.default_rng(swarm)
    p = swarm_at_the_corners(rng, swarm)
    u = np.cumsum(rng.normal(size=(300, columns or swarm)), axis=0) * 0.1
    u[:9] = 0.0
    found = simulated(u, p)
    for column in range(swarm):
        own = u[:, min(column, u.shape[1] - 1)]
        np.testing.assert_allclose(found[:, column], forces(own, p[:, column]), rtol=1e-12, atol=1e-11)


def test_a_particle_does_not_know_of_the_others():
    rng = np.random.default_rng(4)
    p, u = swarm_at_the_corners(rng, 19), rng.normal(size=(50, 1))
    assert np.array_equal(simulated(u, np.ascontiguousarray(p[:, 5:11])), simulated(u, p)[:, 5:11])


def test_steps_of_any_length_end_where_small_ones_do():
    rng = np.random.default_rng(5)
    p = swarm_at_the_corners(rng, 30)
    u = np.cumsum(rng.normal(size=40))
    fine = np.interp(np.arange(39 * 64 + 1) / 64.0, np.arange(40), u)
    np.testing.assert_allclose(simulated(u[:, None], p), simulated(fine[:, None], p)[::64], atol=1e-10)


def test_the_corners_of_a_sharp_flag_lie_where_christopoulos_has_them():
    """k_0 = 10, F_y = 2, alpha = 0.05, beta = 0.7: loaded to u = 1, back to 0, and as far on the other side."""
    k_0, force, alpha, beta = 10.0, 2.0, 0.05, 0.7
    bend = force / k_0
    corners = [0.0, bend, 1.0, 1.0 - beta * bend, (1.0 - beta) * bend, 0.0]
    expected = [0.0, force, force + alpha * k_0 * (1.0 - bend)]
    at_end = alpha * k_0 * corners[3] + (1.0 - alpha) * k_0 * (1.0 - beta) * bend
    expected += [at_end, k_0 * (1.0 - beta) * bend, 0.0]
    u = np.concatenate([corners, -np.array(corners[1:])])
    fine = np.interp(np.arange((u.size - 1) * 50 + 1) / 50.0, np.arange(u.size), u)
    p = np.array([0.0, bend, 1.0 - beta, 1e4, (1.0 - alpha) * k_0, (1.0 - alpha) * k_0, alpha * k_0])[:, None]
    found = simulated(fine[:, None], p)[::50, 0]
    np.testing.assert_allclose(found, [*expected, *(-np.array(expected[1:]))], atol=1e-3)


def test_minor_loops_return_to_the_point_where_they_left():
    u = np.array([0.0, 1.0, 0.6, 0.9, 0.7, 0.9, 0.6, 1.0])
    fine = np.interp(np.arange(7 * 30 + 1) / 30.0, np.arange(8), u)
    p = np.array([0.0, 0.3, 0.3, 4.0, 1.0, 1.0, 0.2])[:, None]
    found = simulated(fine[:, None], p)[::30, 0]
    assert found[1] == pytest.approx(found[7], abs=1e-12)
    assert found[3] == pytest.approx(found[5], abs=1e-12)

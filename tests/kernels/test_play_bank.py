"""Banks of play operators and the curve of dead zones against plain loops."""

import numpy as np

from hysteresis_bench.kernels.dead_zones import dead_zones
from hysteresis_bench.kernels.play_bank import play_bank
from hysteresis_bench.kernels.play_hats import play_hats


def plain(u, radii, coefficients):
    positions, out = [u[0]] * len(radii), []
    for value in u:
        positions = [max(value - r, min(value + r, p)) for r, p in zip(radii, positions, strict=True)]
        out.append(
            sum(c * p ** (m + 1) for p, row in zip(positions, coefficients, strict=True) for m, c in enumerate(row))
        )
    return np.array(out)


def test_a_bank_is_the_sum_of_powers_of_plain_plays():
    rng = np.random.default_rng(4)
    u = np.cumsum(rng.normal(size=300))
    radii, coefficients = rng.uniform(0.0, 4.0, (3, 5)), rng.normal(size=(3, 2, 5))
    swarm = play_bank(u[:, None], radii, coefficients)
    for j in range(5):
        np.testing.assert_allclose(swarm[:, j], plain(u.tolist(), radii[:, j], coefficients[:, :, j]), rtol=1e-12)
    own = play_bank(np.repeat(u[:, None], 5, axis=1), radii, coefficients)
    assert np.array_equal(own, swarm)


def test_a_play_without_width_is_the_input():
    u = np.random.default_rng(2).normal(size=(80, 1))
    assert np.array_equal(play_bank(u, np.zeros((1, 2)), np.ones((1, 1, 2))), np.repeat(u, 2, axis=1))


def test_dead_zones_bend_a_line_on_either_side():
    x = np.linspace(-3.0, 5.0, 41)[:, None]
    edges = np.array([[0.5], [1.5], [-0.5]])
    y = dead_zones(x, np.array([1.0]), np.array([2.0]), edges, np.array([[-1.0], [3.0], [0.7]]))[:, 0]
    for value, found in zip(x[:, 0].tolist(), y.tolist(), strict=True):
        away = value - 1.0
        expected = 2.0 * value
        expected += -1.0 * (away - 0.5) if away > 0.5 else 0.0
        expected += 3.0 * (away - 1.5) if away > 1.5 else 0.0
        expected += 0.7 * (away + 0.5) if away < -0.5 else 0.0
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


def test_curves_of_straight_pieces_are_interpolated_between_their_nodes():
    rng = np.random.default_rng(9)
    u = np.cumsum(rng.normal(size=300))
    radii, weights = np.array([0.0, 1.5])[:, None], rng.normal(size=(2, 4, 1))
    nodes = np.array([-5.0, -1.0, 0.0, 2.0, 9.0])
    positions, expected = [u[0]] * 2, []
    for value in u.tolist():
        positions = [max(value - r, min(value + r, p)) for r, p in zip(radii[:, 0], positions, strict=True)]
        curves = [np.append(0.0, np.cumsum(rise[:, 0])) for rise in weights]
        expected.append(
            0.3 * value + sum(np.interp(p, nodes, curve) for p, curve in zip(positions, curves, strict=True))
        )
    found = play_hats(u[:, None], radii, nodes[:, None], weights, np.array([0.3]))
    np.testing.assert_allclose(found[:, 0], expected, atol=1e-12)


def test_curves_that_share_a_way_or_an_input_are_those_of_a_swarm_of_one():
    rng = np.random.default_rng(5)
    u = np.cumsum(rng.normal(size=(200, 1)), axis=0)
    radii, nodes = rng.uniform(0.0, 3.0, (3, 19)), np.sort(rng.normal(0.0, 5.0, (5, 19)), axis=0)
    radii[:, 4:9], nodes[:, 4:9] = radii[:, 3:4], nodes[:, 3:4]
    weights, slope = rng.normal(size=(3, 4, 19)), rng.normal(size=19)
    weights[1, :, ::2] = 0.0
    swarm = play_hats(u, radii, nodes, weights, slope)
    own = play_hats(np.repeat(u, 19, axis=1), radii, nodes, weights, slope)
    for j in range(19):
        one = slice(j, j + 1)
        alone = play_hats(u, *(np.ascontiguousarray(of[..., one]) for of in (radii, nodes, weights)), slope[one])
        assert np.array_equal(swarm[:, one], alone)
    assert np.array_equal(own, swarm)

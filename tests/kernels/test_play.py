"""The compiled play operator against a plain one and what it is known to do."""

import numpy as np

from hysteresis_bench.kernels.play import play


def test_it_agrees_with_a_plain_dead_band():
    rng = np.random.default_rng(1)
    u = np.cumsum(rng.normal(size=300))
    p, expected = u[0], []
    for value in u:
        if value - p > 1.3:
            p = value - 1.3
        elif p - value > 1.3:
            p = value + 1.3
        expected.append(p)
    assert np.array_equal(play(u[:, None], np.array([1.3]))[:, 0], expected)


def test_one_play_of_a_swarm_equals_a_plain_loop_to_the_last_bit():
    rng = np.random.default_rng(5)
    u, radii = np.cumsum(rng.normal(size=400)), np.array([0.0, 0.3, 5.0])
    swarm = play(u[:, None], radii)
    for j, radius in enumerate(radii.tolist()):
        position, expected = u[0], []
        for value in u.tolist():
            position = max(value - radius, min(value + radius, position))
            expected.append(position)
        assert np.array_equal(swarm[:, j], expected)


def test_a_closed_cycle_encloses_the_area_of_its_dead_band():
    u = np.concatenate([np.linspace(0, 1, 101), np.linspace(1, -1, 201), np.linspace(-1, 1, 201)])
    radius = 0.2
    p = play(u[:, None], np.array([radius]))[:, 0][100:]
    u = u[100:]
    area = abs(np.sum(0.5 * (p[1:] + p[:-1]) * np.diff(u)))
    np.testing.assert_allclose(area, 4 * radius * (1 - radius), rtol=1e-12)  # a parallelogram 2 r by 2 (1 - r)


def test_no_dead_band_is_the_input_to_the_last_bit():
    u = np.random.default_rng(2).normal(size=(80, 3))
    assert np.array_equal(play(u, np.zeros(3)), u)
    assert np.array_equal(play(u[:, :1], np.zeros(2)), np.repeat(u[:, :1], 2, axis=1))

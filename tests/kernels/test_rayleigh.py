"""The compiled Rayleigh law against an integral of play operators and its closed forms."""

from itertools import pairwise

import numpy as np
import pytest

from hysteresis_bench.kernels.play import play
from hysteresis_bench.kernels.rayleigh import rayleigh


@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_integral_of_play_operators(seed):
    u = np.cumsum(np.random.default_rng(seed).normal(size=400))
    count, widest = 4000, np.ptp(u)
    radii = (np.arange(count) + 0.5) * widest / count  # midpoint rule: exact but where a corner falls into a cell
    moved = play(u[:, None], radii) - u[0]
    expected = moved.sum(axis=1) * widest / count
    np.testing.assert_allclose(rayleigh(u[:, None])[:, 0], expected, atol=30 * (widest / count) ** 2)


def test_a_cycle_loses_four_thirds_of_half_the_amplitude_cubed():
    turns = [0, 1, -1, 1]
    u = np.concatenate([np.linspace(a, b, 2001) for a, b in pairwise(turns)])
    r = rayleigh(u[:, None])[:, 0]
    cycle = slice(2001, None)
    area = np.sum(0.5 * (u[cycle][1:] + u[cycle][:-1]) * np.diff(r[cycle]))
    np.testing.assert_allclose(abs(area), 4 / 3 * 0.5, rtol=1e-6)  # Rayleigh's loss, 4/3 nu u^3 with nu = 1/2


def test_a_minor_loop_closes_and_is_forgotten():
    with_loop = np.array([0.0, 2.0, -0.5, 1.0, 0.2, 1.5, -2.5, 0.3])
    without = np.array([0.0, 2.0, -0.5, 1.5, -2.5, 0.3])
    np.testing.assert_allclose(rayleigh(with_loop[:, None])[-3:], rayleigh(without[:, None])[-3:], atol=1e-14)


def test_steps_between_the_samples_do_not_matter():
    corners = np.random.default_rng(7).normal(size=30)
    fine = np.interp(np.linspace(0, 29, 291), np.arange(30), corners)
    np.testing.assert_allclose(rayleigh(fine[:, None])[::10], rayleigh(corners[:, None]), atol=1e-13)

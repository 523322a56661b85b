"""The sum of squares against numpy, in every shape that the objective hands it."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.kernels.squares import differences_into, sum_of_squares


@pytest.mark.parametrize("swarm", [1, 7, 8, 50])
@pytest.mark.parametrize("history", [0, 13])
def test_equals_numpy(swarm: int, history: int) -> None:
    rng = np.random.default_rng(swarm)
    simulated, measured = rng.normal(size=(301, swarm)), rng.normal(size=301)
    expected = np.sum((simulated - measured[:, None])[history:] ** 2, axis=0)
    assert sum_of_squares(simulated[history:], measured[history:]) == pytest.approx(expected, rel=1e-12)


def test_one_column_that_is_not_a_number_leaves_the_others() -> None:
    simulated = np.ones((20, 3))
    simulated[5, 1] = np.nan
    total = sum_of_squares(simulated, np.zeros(20))
    assert np.isnan(total[1])
    assert total[[0, 2]].tolist() == [20.0, 20.0]


def test_differences_are_those_of_the_groups() -> None:
    found = np.random.default_rng(3).normal(size=(40, 3, 5))
    first, differences = np.empty((3, 40)), np.empty((3, 40, 4))
    differences_into(first, differences, found)
    assert np.array_equal(first, found[:, :, 0].T)
    assert np.array_equal(differences, (found[:, :, 1:] - found[:, :, :1]).transpose(1, 0, 2))

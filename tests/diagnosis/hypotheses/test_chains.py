"""Many starts of one hypothesis, on toy problems whose optima are known."""

from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench.diagnosis.hypotheses.chains import HOPES, optimum

DEEP, SHALLOW = 0.2, 0.8


def problem(residuals):
    """residuals : points (dimension, swarm) -> (samples, swarm);  `widths` : columns of every call"""
    widths = []

    def asked(points):
        widths.append(points.shape[1])
        return residuals(points)

    samples = residuals(np.full((2, 1), 0.5)).shape[0]
    return SimpleNamespace(
        residuals=asked,
        squares=lambda points: np.sum(residuals(points) ** 2, axis=0),
        samples=samples,
        worst=1e9,
        widths=widths,
    )


def two_basins(points):
    """Least at (DEEP, 0.5), where 0.1 is left, and again near (SHALLOW, 0.5), where 0.4 is."""
    x, y = points
    return np.stack([12.0 * (x - DEEP) * (x - SHALLOW), y - 0.5, 0.1 + 0.5 * (x - DEEP)])


def starts(*xs):
    return np.array([xs, np.linspace(0.3, 0.7, len(xs))])


def test_chains_that_have_met_are_followed_once():
    one = problem(two_basins)
    point, left = optimum(one, starts(0.15, 0.18, 0.21, 0.22, 0.25, 0.28))
    assert point[:, 0] == pytest.approx([DEEP, 0.5], abs=0.02)
    assert not left
    first, last = 6 * 3, 3  # chains times (dimension + 1)
    assert one.widths[0] == first
    assert one.widths[-1] == last
    halves = one.widths.index(last)
    assert set(one.widths[halves:]) == {last}, "one chain is left after half of the first iterations"


def test_another_basin_is_kept_beside_many_chains_in_one():
    """All but one begin near the shallow one."""
    point, _ = optimum(problem(two_basins), starts(0.76, 0.78, 0.8, 0.82, 0.84, 0.24))
    assert point[0, 0] == pytest.approx(DEEP, abs=0.02)


@pytest.mark.parametrize(("ratio", "behind"), [(0.9 * HOPES[-1], False), (1.1 * HOPES[-1], True)])
def test_what_stays_far_behind_is_left(ratio, behind):
    one = problem(two_basins)
    point, _ = optimum(one, starts(0.15, 0.7))
    rmse = float(np.sqrt(one.squares(point)[0] / one.samples))
    again, told = optimum(one, starts(0.15, 0.7), near=rmse / ratio)
    assert told is behind
    assert again == pytest.approx(point, abs=1e-3)

"""The least squares of many chains against scipy's, and what folds may not see."""

from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.cross_validation import advantage
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.least_squares import descend, errors, point_of, split, values_of
from hysteresis_bench.fit.unseen.left_out import FOLDS, cut, left_out_errors
from tests.diagnosis.generator import make


def problem_of(names=("record-offset",)):
    case = make(1, "bouc-wen", hidden=())
    return Stack(registry.build("models", "bouc-wen"), case.dataset.fitted).problem(names)


def test_chains_reach_what_scipy_reaches():
    problem = problem_of()
    starts = np.random.default_rng(0).random((problem.space.dimension, 6))
    points, squares = descend(problem, starts, iterations=60)
    reference = least_squares(
        lambda point: problem.residuals(point[:, None])[:, 0],
        points[:, np.argmin(squares)],
        bounds=(0, 1),
        x_scale="jac",
    )
    assert np.min(squares) <= 2.0 * reference.cost * (1 + 1e-6)
    assert np.all((points >= 0.0) & (points <= 1.0))
    assert np.allclose(squares, np.sum(errors(problem, points) ** 2, axis=0))


def test_a_chain_does_not_depend_on_its_neighbours():
    problem = problem_of()
    starts = np.random.default_rng(1).random((problem.space.dimension, 4))
    together, _ = descend(problem, starts, iterations=5)
    alone, _ = descend(problem, starts[:, 2:3], iterations=5)
    assert np.allclose(together[:, 2], alone[:, 0], atol=1e-6)


def test_a_fold_does_not_see_what_it_leaves_out():
    problem = problem_of(())
    blocks = cut(problem.records)
    weights = blocks.training[:, :1]
    start = np.full((problem.space.dimension, 1), 0.4)
    expected, _ = descend(problem, start, weights, iterations=40)
    changed = tuple(
        replace(record, output=np.where(fold == 0, record.output + 100.0, record.output))
        for record, fold in zip(problem.records, split(blocks.fold, problem.records), strict=True)
    )
    found, _ = descend(replace(problem, records=changed), start, weights, iterations=40)
    assert np.allclose(found, expected, atol=1e-9)


def test_folds_share_the_samples_and_meet_all_phases():
    records = problem_of().records
    blocks = cut(records)
    assert np.array_equal(np.unique(blocks.fold), np.arange(FOLDS))
    counts = np.bincount(blocks.fold)
    assert counts.max() < 1.3 * counts.min()


def test_left_out_errors_are_a_little_larger_than_fitted_ones():
    problem = problem_of()
    points, squares = descend(problem, np.full((problem.space.dimension, 1), 0.4), iterations=60)
    blocks = cut(problem.records)
    left_out = left_out_errors(problem, points[:, 0], blocks)
    assert squares[0] < np.sum(left_out**2) < 1.05 * squares[0]
    assert advantage(0.5 * left_out, left_out, blocks) > 5.0
    assert advantage(left_out, left_out, blocks) == 0.0


def test_values_and_points_are_inverse():
    problem = problem_of()
    point = np.random.default_rng(2).random(problem.space.dimension)
    assert np.allclose(point_of(problem, values_of(problem, point)), point, atol=1e-12)

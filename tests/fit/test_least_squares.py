"""The least squares of many chains against scipy's, and what folds may not see."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.least_squares import (
    at_bound,
    descend,
    errors,
    not_overlooked,
    point_of,
    polish,
    split,
    values_of,
)
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.unseen.advantage import advantage, chance
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.left_out import FOLDS, cut, left_out_errors
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record
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
    assert chance(0.5 * left_out, left_out, blocks) < 1e-6 < 0.99 < chance(left_out, 0.5 * left_out, blocks)
    assert advantage(left_out, left_out, blocks) == 0.0
    assert chance(left_out, left_out, blocks) == 1.0


@pytest.mark.parametrize("count", [8, 24])
@pytest.mark.parametrize("heavy", [False, True])
def test_a_p_value_of_blocks_is_none_too_small(count, heavy):
    """Where neither predicts better. The larger of two statistics, read as normal, is below 0.01 twice as often."""
    rng, blocks = np.random.default_rng(11), Blocks(np.arange(count), np.arange(count) % 4, 4)
    gains = rng.standard_t(3, (1500, count)) if heavy else rng.standard_normal((1500, count))
    ours = np.full(count, 10.0)
    p = np.array([chance(ours, np.sqrt(100.0 + one), blocks) for one in gains])
    assert np.mean(p < 0.01) <= 0.013  # 0.010, and 1.2 times its standard error of 1500 draws


def test_values_and_points_are_inverse():
    problem = problem_of()
    point = np.random.default_rng(2).random(problem.space.dimension)
    assert np.allclose(point_of(problem, values_of(problem, point)), point, atol=1e-12)


TRUTH = {"alpha": 0.6, "beta": 1.1, "gamma": 0.4, "d": 1.3}


def around(effect, hum=0.0):
    """The problem of a Bouc-Wen loop with a hum, with one effect around the model, and the model's own true values."""
    model, time = registry.build("models", "bouc-wen"), np.linspace(0.0, 4.0, 800)
    own = np.array([TRUTH[q.name] for q in model.parameters])
    clean = Record(time, 2.0 * np.sin(np.pi * time**1.3), None)
    output = System(model).respond(clean, own[:, None])[:, 0] + hum * np.cos(2 * np.pi * 23.7 * time)
    record = replace(clean, output=output + 0.01 * np.random.default_rng(5).standard_normal(time.size))
    system = System(model, registry.build_effects(model, (effect,)))
    return Problem(system, (record,), Space(system.box((record,))), LOSSES["rmse"]), own


def test_a_frequency_that_a_search_passed_over_is_found():
    problem, own = around("periodic-disturbance", hum=0.3)
    wrong = problem.space.from_unit(np.full((problem.space.dimension, 1), 0.5))[:, 0]
    found = dict(zip(problem.space.names, not_overlooked(problem, wrong, lambda bare: own), strict=True))
    assert abs(found["periodic-disturbance.frequency"] - 23.7) < 0.01
    assert abs(np.hypot(found["periodic-disturbance.cosine"], found["periodic-disturbance.sine"]) - 0.3) < 0.01


def test_a_fit_with_an_effect_is_no_worse_than_without():
    problem, own = around("play-bank")
    wrong = problem.space.from_unit(np.full((problem.space.dimension, 1), 0.5))
    found = not_overlooked(problem, wrong[:, 0], lambda bare: own)
    assert problem.losses(problem.space.to_unit(found[:, None]))[0] < 0.011


def test_what_a_search_found_stays_where_nothing_is_better():
    problem, own = around("drift")
    best = polish(problem, np.append(own, 0.0))
    assert np.array_equal(not_overlooked(problem, best, lambda bare: own), best)


def test_a_limiting_form_is_no_edge_of_a_box():
    bend = Parameter("bend", 1.0, 1000.0, scaling="log", limit=1000.0)
    space = Space((bend, Parameter("gain", 0.0, 2.0)))
    assert at_bound(space, np.array([1000.0, 2.0])).tolist() == [False, True]
    assert at_bound(space, np.array([1.0, 1.0])).tolist() == [True, False]
    narrower = Space((bend.within(1.0, 20.0),))
    assert at_bound(narrower, np.array([20.0])).tolist() == [True]

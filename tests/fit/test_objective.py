"""The meter counts exactly, refuses exactly, never answers NaN, and keeps the trace."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model, Optimizer
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import BudgetSpent, Objective, OutsideBox, Problem
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import shared_start
from hysteresis_bench.parameters import Parameter, Space
from tests.conftest import record


def test_every_column_counts_and_the_one_past_the_budget_is_refused(polynomial_problem):
    objective = Objective(polynomial_problem, 10)
    objective(np.array([0.5, 0.5]))
    objective.residuals(np.array([0.5, 0.5]))
    objective.many(np.full((2, 5), 0.25))
    assert objective.evaluations == 7
    better = polynomial_problem.space.to_unit(np.array([[1.0], [0.5]]))
    swarm = np.hstack([np.full((2, 2), 0.1), better, np.full((2, 4), 0.2)])
    with pytest.raises(BudgetSpent):
        objective.many(swarm)
    assert objective.evaluations == 10
    assert objective.best < 1e-12, "the third column was still affordable and must be scored"
    for call in (
        lambda: objective(swarm[:, 0]),
        lambda: objective.residuals(swarm[:, 0]),
        lambda: objective.many(swarm),
    ):
        with pytest.raises(BudgetSpent):
            call()
    assert objective.evaluations == 10


def test_budget_spent_is_not_caught_by_an_exception_handler():
    assert not issubclass(BudgetSpent, Exception)


def test_loss_is_the_rmse_computed_plainly(polynomial_problem):
    rng = np.random.default_rng(1)
    points = rng.random((2, 17))
    losses = Objective(polynomial_problem, 17).many(points)
    measured = polynomial_problem.records[0]
    for column in range(17):
        a = -2.0 + 6.0 * points[0, column]
        b = np.exp(np.log(0.01) + (np.log(10) - np.log(0.01)) * points[1, column])
        error = [a * u + b * u**3 - y for u, y in zip(measured.input, measured.output, strict=True)]
        assert losses[column] == pytest.approx(np.sqrt(sum(e * e for e in error) / len(error)), rel=1e-12)


@pytest.mark.parametrize("name", sorted(LOSSES))
def test_residuals_and_losses_tell_the_same(polynomial_problem, name):
    problem = replace(polynomial_problem, loss=LOSSES[name])
    point = np.array([0.3, 0.8])
    squares = np.sum(problem.residuals(point[:, None]) ** 2)
    expected = problem.loss.of(np.array([squares]), problem.samples, problem.scale)
    assert problem.losses(point[:, None]) == pytest.approx(expected, rel=1e-12)


def test_history_is_simulated_but_not_scored(polynomial_problem):
    wrong_start = record().output.copy()
    wrong_start[:5] += 100.0
    problem = replace(polynomial_problem, records=(replace(record(), output=wrong_start, history=5),))
    truth = problem.space.to_unit(np.array([[1.0], [0.5]]))
    assert problem.losses(truth)[0] < 1e-12
    assert problem.samples == 35


@pytest.mark.parametrize("bad", [1.0 + 1e-9, -1e-9, np.nan])
def test_a_point_outside_the_box_is_an_error_and_costs_nothing(polynomial_problem, bad):
    objective = Objective(polynomial_problem, 10)
    with pytest.raises(OutsideBox, match="b ="):
        objective(np.array([0.5, bad]))
    assert objective.evaluations == 0


def test_a_wrong_shape_is_told(polynomial_problem):
    with pytest.raises(ValueError, match=r"\(2, n\)"):
        Objective(polynomial_problem, 10).many(np.zeros((3, 4)))


@dataclass(frozen=True)
class Broken(Model):
    """NaN, infinite or huge, as its one parameter says."""

    parameters = (Parameter("a", 0.0, 1.0),)

    def simulate(self, signal, p):
        value = np.where(p.a < 0.3, np.nan, np.where(p.a < 0.6, np.inf, 1e200))
        return np.repeat(value[None, :], signal.input.shape[0], axis=0)


def test_nan_infinity_and_overflow_answer_the_same_finite_ceiling():
    system = System(Broken())
    problem = Problem(system, (record(),), Space(system.parameters), LOSSES["rmse"])
    losses = Objective(problem, 9).many(np.array([[0.1, 0.4, 0.9]]))
    assert np.all(losses == problem.ceiling)
    assert np.isfinite(problem.ceiling)
    assert np.all(np.isfinite(problem.residuals(np.array([[0.1]]))))


def test_trace_keeps_every_improvement_and_nothing_else(polynomial_problem):
    rng = np.random.default_rng(2)
    objective = Objective(polynomial_problem, 100)
    losses = np.concatenate([objective.many(rng.random((2, n))) for n in (1, 50, 49)])
    trace = objective.trace
    assert np.all(np.diff(trace.losses) < 0)
    best = np.minimum.accumulate(losses)
    assert trace.losses == pytest.approx(np.unique(best)[::-1])
    assert best[trace.evaluations - 1] == pytest.approx(trace.losses)
    values = polynomial_problem.space.to_unit(trace.points.T)
    assert polynomial_problem.losses(values) == pytest.approx(trace.losses, rel=1e-9)


def test_a_swarm_cut_into_blocks_scores_as_one(polynomial_problem):
    long = Problem(polynomial_problem.system, (record(200_000),), polynomial_problem.space, LOSSES["rmse"])
    assert (polynomial_problem.block, long.block) == (64, 16)
    points = np.random.default_rng(3).random((2, 50))
    one_by_one = [long.losses(points[:, [column]])[0] for column in range(50)]
    assert long.losses(points) == pytest.approx(one_by_one, rel=1e-12)


def test_points_are_left_as_they_were(polynomial_problem):
    points = np.random.default_rng(4).random((2, 6))
    before = points.copy()
    Objective(polynomial_problem, 6).many(points)
    assert np.array_equal(points, before)


class Prying(Optimizer):
    """Tries to buy evaluations, to forge the best and to change the problem; notes what let it."""

    def search(self, objective, start, rng):
        self.let = []
        objective.many(start(3))
        for name, value in (("evaluations", 0), ("budget", 10**6), ("best", 0.0), ("dimension", 1), ("_problem", None)):
            try:
                setattr(objective, name, value)
                self.let.append(name)
            except AttributeError:
                pass
        type(objective).evaluations = property(lambda self: 0)
        self.let += [name for name in dir(objective) if isinstance(getattr(objective, name), (Objective, Problem))]
        while True:
            objective.many(start(3))


def test_an_optimizer_cannot_reach_the_counters_the_best_or_the_problem(polynomial_problem):
    optimizer, start = Prying(), shared_start(2, 1)
    found = search(polynomial_problem, optimizer, budget=10, start=start, rng=np.random.default_rng(0))
    assert optimizer.let == []
    assert found.evaluations == 10
    assert found.spent
    assert np.isfinite(found.loss)


def test_what_a_plugin_gets_cannot_be_written_into():
    column = np.linspace(20.0, 30.0, 40)
    given = replace(record(), columns={"temperature": column})
    signal = given.signal
    arrays = [given.time, given.input, given.output, given.measured, given.columns["temperature"]]
    arrays += [signal.time, signal.input, signal.columns["temperature"], signal.with_input(np.ones((40, 3))).input]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    with pytest.raises(TypeError):
        signal.columns["temperature"] = column
    column[0] = 0.0  # whoever made an array may still write into his own

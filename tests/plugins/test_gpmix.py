"""G-Pmix and the genetic algorithm: schedules, operators, the genetic step, the budget."""

import numpy as np
import pytest

from hysteresis_bench.compose import System
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import BudgetSpent, Objective, Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.optimizers._swarm import Swarm
from hysteresis_plugins.optimizers.ga import Ga, exchanged, mutated
from hysteresis_plugins.optimizers.gpmix import Gpmix

PUBLISHED = np.array([0.304225, 0.675313, 0.497724, 1.045814])  # PEA paper, Table 2


def start(particles):
    return np.random.default_rng(0).random((100, 4))[:particles].T


def meter(budget, samples=300):
    system = System(BoucWen())
    u = 2.5 * np.sin(2 * np.pi * 3 * np.linspace(0, 1, samples))
    time = np.linspace(0, 6, samples)
    y = system.simulate(Signal(time, u[:, None]), PUBLISHED[:, None])[:, 0]
    box = tuple(parameter.within(0, 2) for parameter in BoucWen.parameters)
    return Objective(Problem(system, (Record(time, u, y),), Space(box), LOSSES["rmse"]), budget)


def spent(optimizer, budget, seed=1):
    objective = meter(budget)
    with pytest.raises(BudgetSpent):
        optimizer.search(objective, start, np.random.default_rng(seed))
    return objective


class Bowl:
    """A loss known in closed form, unmetered: the squared distance from a corner."""

    dimension, budget, evaluations = 4, 10**9, 0

    def many(self, points):
        self.evaluations += points.shape[1]
        assert points.min() >= 0
        assert points.max() <= 1
        return np.sum(points**2, axis=0)


def test_schedule_is_the_printed_one():
    gpmix = Gpmix()
    assert gpmix.coefficients(0) == (0.9, 4.0, 1.0)
    assert gpmix.coefficients(50) == pytest.approx((0.65, 2.5, 2.5))
    assert gpmix.coefficients(100) == pytest.approx((0.4, 1.0, 4.0))


@pytest.mark.parametrize("optimizer", [Ga(), Gpmix(), Gpmix(particles=7, cycle=3)])
@pytest.mark.parametrize("budget", [1, 49, 5331])
def test_spends_the_budget_exactly(optimizer, budget):
    assert spent(optimizer, budget).evaluations == budget


@pytest.mark.parametrize("optimizer", [Ga(), Gpmix(cycle=10), Gpmix(cycle=10, enters="position")])
def test_same_seed_same_trace_and_another_seed_another(optimizer):
    first, again, other = (spent(optimizer, 2000, seed).trace for seed in (3, 3, 4))
    np.testing.assert_array_equal(first.losses, again.losses)
    np.testing.assert_array_equal(first.points, again.points)
    assert not np.array_equal(first.losses, other.losses)


def test_crossover_only_moves_genes_between_particles():
    rng = np.random.default_rng(5)
    points = rng.random((4, 31))
    children = exchanged(points, 1.0, rng)
    np.testing.assert_array_equal(np.sort(children, axis=1), np.sort(points, axis=1))
    assert np.any(children != points)
    np.testing.assert_array_equal(exchanged(points, 0.0, rng), points)


def test_crossover_and_mutation_keep_their_probabilities_and_the_box():
    rng = np.random.default_rng(6)
    points = rng.random((4, 100_000))
    changed = np.mean(np.any(exchanged(points, 0.2, rng) != points, axis=0))
    assert changed == pytest.approx(0.2 * (1 - 0.5**4), abs=0.01)
    children = mutated(points, 0.2, rng)
    assert np.mean(children != points) == pytest.approx(0.2, abs=0.01)
    assert children.min() >= 0
    assert children.max() <= 1


def test_genetic_step_keeps_the_better_ones_and_never_worsens_a_place():
    rng, bowl = np.random.default_rng(7), Bowl()
    swarm = Swarm.scattered(start, rng, 50, 0.2)
    swarm.evaluate(bowl)
    before, position, velocity = swarm.best_loss.copy(), swarm.position.copy(), swarm.velocity.copy()
    better = before < before.mean()
    Gpmix().evolve(swarm, bowl, rng)
    new = swarm.best_loss != before
    assert new.any()
    assert not new[better].any()
    np.testing.assert_array_equal(swarm.position[:, ~new], position[:, ~new])
    np.testing.assert_array_equal(swarm.velocity[:, ~new], velocity[:, ~new])
    assert np.all(swarm.velocity[:, new] == 0)
    assert np.all(np.sort(swarm.best_loss) <= np.sort(before))
    np.testing.assert_allclose(swarm.best_loss, np.sum(swarm.best**2, axis=0))
    assert swarm.leader_loss == swarm.best_loss.min()
    assert 50 < bowl.evaluations <= 50 + np.count_nonzero(~better)


def test_to_the_letter_the_step_takes_positions_and_leaves_velocity_and_better_memories():
    rng, bowl = np.random.default_rng(7), Bowl()
    swarm = Swarm.scattered(start, rng, 50, 0.2)
    swarm.evaluate(bowl)
    swarm.best[:, :25], swarm.best_loss[:25] = 0.01, 4e-4  # half of them have been at a better place
    before, position, velocity = swarm.best_loss.copy(), swarm.position.copy(), swarm.velocity.copy()
    Gpmix(enters="position").evolve(swarm, bowl, rng)
    moved = np.any(swarm.position != position, axis=0)
    assert moved[swarm.loss >= swarm.loss.mean()].any()
    assert not moved[swarm.loss < swarm.loss.mean()].any()
    assert np.all(np.sum(swarm.position**2, axis=0)[moved] < swarm.loss.max())
    np.testing.assert_array_equal(swarm.velocity, velocity)
    np.testing.assert_array_equal(swarm.best_loss[:25], before[:25])
    assert np.any(swarm.best_loss[25:] < before[25:])
    np.testing.assert_allclose(swarm.best_loss, np.sum(swarm.best**2, axis=0))
    with pytest.raises(ValueError, match='enters = "both" must be'):
        Gpmix(enters="both")


def test_genetic_step_survives_a_swarm_that_has_collapsed():
    rng, bowl = np.random.default_rng(8), Bowl()
    swarm = Swarm.scattered(lambda particles: np.full((4, particles), 0.5), rng, 50, 0.2)
    swarm.evaluate(bowl)
    Gpmix().evolve(swarm, bowl, rng)
    assert swarm.best_loss.min() <= 1.0


def test_both_stop_at_the_accuracy():
    for optimizer in (Ga(accuracy=0.1), Gpmix(accuracy=0.1)):
        objective = meter(100_000)
        optimizer.search(objective, start, np.random.default_rng(9))
        assert objective.best <= 0.1
        assert objective.evaluations < 100_000


def test_gpmix_closes_in_on_the_published_parameters():
    objective = spent(Gpmix(), 60_000, 10)
    assert objective.best < 1e-3
    np.testing.assert_allclose(objective.trace.points[-1], PUBLISHED, rtol=0.1)


def test_bad_settings_are_refused():
    with pytest.raises(ValueError, match="crossover_probability"):
        Ga(crossover_probability=1.5)
    with pytest.raises(ValueError, match="first and last"):
        Gpmix(inertia=(0.9,))  # type: ignore[arg-type]

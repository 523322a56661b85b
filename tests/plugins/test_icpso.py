"""ICPSO: its flight time and logistic map against hand computation, its budget, its box."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.fit.objective import BudgetSpent
from hysteresis_plugins.optimizers.icpso import DEAD, Icpso, alive


class Sphere:
    """A metered sum of squares about a point of the unit box; keeps what it was asked."""

    def __init__(self, centre, budget):
        self.centre = np.asarray(centre, dtype=float)[:, None]
        self.dimension, self.budget, self.evaluations = self.centre.size, budget, 0
        self.calls, self.losses = [], []

    def many(self, points):
        affordable = points[:, : self.budget - self.evaluations]
        losses = np.sum((affordable - self.centre) ** 2, axis=0)
        self.calls.append(affordable.copy())
        self.losses.append(losses)
        self.evaluations += losses.size
        if affordable.shape[1] < points.shape[1] or not points.shape[1]:
            raise BudgetSpent
        return losses


def searched(centre, budget, **settings):
    objective = Sphere(centre, budget)
    rng = np.random.default_rng(1)
    with pytest.raises(BudgetSpent):
        Icpso(accuracy=0.0, **settings).search(objective, lambda n: rng.random((objective.dimension, n)), rng)
    return objective


def test_flight_time_falls_linearly():
    icpso = Icpso(flight_time=2.0, shortening=0.5)
    assert [icpso.time_of_flight(t, 4) for t in (0, 1, 2, 3)] == [2.0, 1.75, 1.5, 1.25]


def test_logistic_map_against_hand_computation():
    sequence = Icpso(chaos_steps=3).chaotic_sequence(np.array([[0.1], [0.3]]), np.random.default_rng(0))
    # 4*0.1*0.9 = 0.36, 4*0.36*0.64 = 0.9216, 4*0.9216*0.0784 = 0.28901376; 0.84, 0.5376, 0.99434496
    np.testing.assert_allclose(sequence, [[0.36, 0.9216, 0.28901376], [0.84, 0.5376, 0.99434496]], rtol=1e-12)


def test_logistic_map_never_rests():
    rng = np.random.default_rng(0)
    moved = alive(DEAD[:, None], rng)
    assert np.all(np.min(np.abs(moved - DEAD), axis=1) >= 1e-4)
    assert np.all((moved > 0.0) & (moved < 1.0))
    untouched = np.array([[0.1], [0.6]])
    assert np.array_equal(alive(untouched, rng), untouched)
    sequence = Icpso(chaos_steps=200).chaotic_sequence(DEAD[:, None], rng)
    # a map at rest would spread over nothing; the invariant density of mu = 4 has deviation 1 / sqrt(8)
    assert np.all(np.abs(sequence.std(axis=1) - np.sqrt(0.125)) < 0.08)


def test_three_candidates_follow_equations_8_to_13():
    icpso = Icpso(inertia=0.5, cognitive=0.0, social=0.0, speed_limit=0.1, particles=1)
    x, v = np.array([[0.5], [0.98]]), np.array([[0.04], [0.3]])
    positions, velocities = icpso.candidates(x, v, x, x, 2.0, np.random.default_rng(0))
    for position, velocity in zip(positions, velocities, strict=True):
        # w v = 0.02 and 0.15, the second limited to 0.1; T = 2; the second stops on its wall
        np.testing.assert_allclose(position, [[0.54], [1.0]])
        np.testing.assert_allclose(velocity, [[0.02], [0.0]])


@pytest.mark.parametrize("budget", [7, 50, 51, 250, 1234])
def test_budget_is_spent_exactly_inside_the_box(budget):
    objective = searched([0.0, 1.0, 0.3], budget)
    points = np.hstack(objective.calls)
    assert objective.evaluations == budget == points.shape[1]
    assert np.all((points >= 0.0) & (points <= 1.0))


def test_an_iteration_costs_three_swarms_and_the_chaos_search():
    icpso = Icpso(particles=20, chaos_steps=7)
    objective = searched([0.2, 0.7], 20 + 3 * 67, particles=20, chaos_steps=7)
    assert icpso.evaluations_per_iteration(2) == 67
    assert [call.shape[1] for call in objective.calls] == [20, 60, 7, 60, 7, 60, 7, 0][: len(objective.calls)]


def test_chaos_search_does_not_repeat_itself():
    objective = searched([0.5, 0.5], 4000, particles=10, chaos_steps=20)
    chaos = np.hstack([call for call in objective.calls if call.shape[1] == 20])
    assert np.unique(chaos, axis=1).shape[1] == chaos.shape[1]


@pytest.mark.parametrize("centre", [[0.3, 0.6, 0.8], [0.0, 1.0, 0.5]])
def test_finds_a_minimum_inside_and_on_the_walls(centre):
    assert np.min(np.concatenate(searched(centre, 20000).losses)) < 1e-8


def test_ends_early_at_the_accuracy():
    objective = Sphere([0.5, 0.5], 100_000)
    rng = np.random.default_rng(0)
    Icpso(accuracy=1e-3).search(objective, lambda n: rng.random((2, n)), rng)
    assert np.min(np.concatenate(objective.losses)) < 1e-3
    assert objective.evaluations < 5000


@pytest.mark.parametrize("settings", [{"particles": 0}, {"shortening": 1.5}, {"logistic": 4.1}, {"flight_time": 0.0}])
def test_refuses_settings_without_meaning(settings):
    with pytest.raises(ValueError, match=next(iter(settings))):
        Icpso(**settings)

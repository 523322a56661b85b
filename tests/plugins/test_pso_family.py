"""The particle swarms against hand-computed schedules and a plain-Python twin, and all optimizers against luck."""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.fit.objective import BudgetSpent
from hysteresis_plugins.optimizers.mpso import Mpso
from hysteresis_plugins.optimizers.pso import Pso
from hysteresis_plugins.optimizers.pso_constriction import PsoConstriction

TARGET = np.array([0.31, 0.02, 0.55, 0.97, 0.64])


@dataclass
class Sphere:
    """Distance to a target near two walls, on the least meter that stops a search."""

    budget: int
    dimension: int = 5
    evaluations: int = 0
    best: float = np.inf
    linear: tuple[int, ...] = ()
    swarms: list[np.ndarray] = field(default_factory=list)

    def many(self, points):
        affordable = points[:, : self.budget - self.evaluations]
        self.evaluations += affordable.shape[1]
        if affordable.shape[1] < points.shape[1]:
            raise BudgetSpent
        losses = np.sqrt(((affordable - TARGET[:, None]) ** 2).sum(axis=0))
        self.best = min(self.best, float(losses.min()))
        self.swarms.append(np.array(points))
        return losses

    def __call__(self, point):
        return float(self.many(np.asarray(point).reshape(-1, 1))[0])

    def residuals(self, point):
        return self.residual_swarm(np.asarray(point).reshape(-1, 1))[:, 0]

    def residual_swarm(self, points):
        self.many(points)
        return np.asarray(points) - TARGET[:, None]


def search(optimizer, budget, seed=0):
    objective = Sphere(budget)
    first = np.random.default_rng([seed, 1]).random((1000, 5)).T
    with contextlib.suppress(BudgetSpent):
        optimizer.search(objective, lambda particles: first[:, :particles], np.random.default_rng([seed, 2]))
    return objective


def test_mpso_schedule_begins_and_ends_as_printed():
    schedule = Mpso().coefficients
    # e^-70 at the beginning, e^0 at the end
    assert schedule(0, 300) == pytest.approx((0.9, 2.5, 0.5), abs=1e-12)
    assert schedule(300, 300) == pytest.approx((0.4, 1.3, 1.7), abs=1e-12)


def test_mpso_schedule_at_hand_computed_iterations():
    # n/Ξ = 0.5: 0.5^6 = 1/64, e^(-70/64) = 0.3349580
    assert Mpso().coefficients(150, 300) == pytest.approx((0.65, 2.09805035, 0.90194965), abs=1e-8)
    # n/Ξ = 0.6: 0.4^6 = 0.004096, e^-0.28672 = 0.7507219
    assert Mpso().coefficients(180, 300) == pytest.approx((0.6, 1.59913372, 1.40086628), abs=1e-8)


def test_mpso_coefficients_turn_at_54_percent_of_the_iterations():
    turn = 1.0 - (math.log(2.0) / 70.0) ** (1.0 / 6.0)
    assert turn == pytest.approx(0.5366, abs=1e-4)
    _, cognitive, social = Mpso().coefficients(turn, 1)
    assert cognitive == pytest.approx((2.5 + 1.3) / 2.0, abs=1e-12)
    assert social == pytest.approx((0.5 + 1.7) / 2.0, abs=1e-12)


def test_mpso_makes_the_papers_300_iterations_of_15050_evaluations():
    class Counted(Mpso):
        seen: list = []  # noqa: RUF012

        def coefficients(self, n, iterations):
            self.seen.append((n, iterations))
            return super().coefficients(n, iterations)

    objective = search(Counted(accuracy=0.0), 15050)
    assert len(objective.swarms) == 301
    # the one more step finds the budget spent
    assert Counted.seen == [(n, 300) for n in range(1, 301)] + [(300, 300)]


def twin(first, rng, steps, coefficients, speed_limit, threshold=None):
    """Particle by particle, coordinate by coordinate: the paper's steps 1 to 5 in plain Python."""
    dimension, particles = first.shape

    def table(values):
        return values.tolist()

    def loss(x):
        return math.sqrt(sum((x[j] - TARGET[j]) ** 2 for j in range(dimension)))

    x = [[first[j, i] for j in range(dimension)] for i in range(particles)]
    rand2 = table(rng.random((dimension, particles)))
    v = [[-speed_limit + 2.0 * speed_limit * rand2[j][i] for j in range(dimension)] for i in range(particles)]
    p = [list(particle) for particle in x]
    g = list(min(x, key=loss))
    swarms = [[list(particle) for particle in x]]
    stopped = mutated = 0
    for n in range(1, steps + 1):
        inertia, c1, c2 = coefficients(n)
        r1, r2 = table(rng.random((dimension, particles))), table(rng.random((dimension, particles)))
        for i in range(particles):
            for j in range(dimension):
                v[i][j] = inertia * v[i][j] + c1 * (r1[j][i] * (p[i][j] - x[i][j])) + c2 * (r2[j][i] * (g[j] - x[i][j]))
                v[i][j] = max(-speed_limit, min(speed_limit, v[i][j]))
                x[i][j] += v[i][j]
                if not 0.0 <= x[i][j] <= 1.0:
                    x[i][j], v[i][j] = (0.0 if x[i][j] < 0.0 else 1.0), 0.0
                    stopped += 1
        if threshold is not None:
            rand3, rand4, rand5 = table(rng.random((3, particles)))
            for i in range(particles):
                if rand3[i] > threshold:
                    x[i][math.ceil(dimension * rand4[i]) - 1] = rand5[i]
                    mutated += 1
        for i in range(particles):
            if loss(x[i]) < loss(p[i]):
                p[i] = list(x[i])
            if loss(x[i]) < loss(g):
                g = list(x[i])
        swarms.append([list(particle) for particle in x])
    return np.array(swarms).transpose(0, 2, 1), stopped, mutated


def compared(optimizer, coefficients, speed_limit, threshold=None):
    steps = 12
    objective = search(optimizer, optimizer.particles * (steps + 1))
    first = np.random.default_rng([0, 1]).random((1000, 5)).T[:, : optimizer.particles]
    expected, stopped, mutated = twin(first, np.random.default_rng([0, 2]), steps, coefficients, speed_limit, threshold)
    assert np.array(objective.swarms) == pytest.approx(expected, abs=1e-12)
    assert stopped > 0, "the example must reach a wall"
    return objective.swarms, mutated


def test_pso_equals_its_plain_twin():
    swarms, _ = compared(Pso(particles=20), lambda n: (0.9, 0.5, 0.5), 0.15)
    steps = [np.abs(after - before).max() for before, after in pairwise(swarms)]
    assert max(steps) == pytest.approx(0.15), "the example must reach the speed limit, and nothing may pass it"


def test_mpso_equals_its_plain_twin():
    optimizer = Mpso(particles=20, mutation_threshold=0.8)
    _, mutated = compared(optimizer, lambda n: optimizer.coefficients(n, 12), 0.15, 0.8)
    assert mutated > 0


def test_pso_constriction_equals_its_plain_twin():
    chi = 0.729843788128357565675589  # 2 / (2.1 + sqrt(0.41)), to 24 digits
    compared(PsoConstriction(particles=20), lambda n: (chi, 2.05 * chi, 2.05 * chi), 0.5)


@pytest.mark.parametrize("threshold", [0.95, 0.8])
def test_mutation_moves_the_share_of_particles_that_the_threshold_leaves(threshold):
    # a swarm that stands still moves only by mutation
    still = Mpso(
        mutation_threshold=threshold, cognitive_first=0, cognitive_last=0, social_first=0, social_last=0,
        speed_limit=1e-12, accuracy=0.0,
    )  # fmt: skip
    swarms = np.array(search(still, 50 * 401).swarms)
    moved = np.abs(np.diff(swarms, axis=0)) > 1e-9
    per_particle = moved.sum(axis=1)
    assert per_particle.max() == 1, "one coordinate of a particle"
    share = per_particle.mean()
    # binomial, 20 000 draws: five standard deviations
    assert share == pytest.approx(1.0 - threshold, abs=5.0 * math.sqrt(threshold * (1.0 - threshold) / 20_000))
    by_coordinate = moved.sum(axis=(0, 2))
    assert by_coordinate.min() > 0.8 * by_coordinate.mean()


@pytest.mark.parametrize("optimizer", [Pso(accuracy=0.05), Mpso(accuracy=0.05)], ids=["pso", "mpso"])
def test_the_search_ends_at_its_accuracy(optimizer):
    objective = search(optimizer, 50_000)
    losses = [np.sqrt(((swarm - TARGET[:, None]) ** 2).sum(axis=0)).min() for swarm in objective.swarms]
    assert losses[-1] < 0.05 <= min(losses[:-1])


@pytest.fixture(scope="module")
def luck():
    random = registry.build("optimizers", "random-search")
    return float(np.median([search(random, 3000, seed).best for seed in range(9)]))


OTHERS = [
    name
    for name in registry.names("optimizers")
    if name != "random-search" and registry.load("optimizers", name).distribution == "hysteresis-bench"
]


@pytest.mark.parametrize("name", OTHERS)
def test_beats_random_search_on_a_smooth_problem(name, luck):
    assert search(registry.build("optimizers", name), 3000).best < luck

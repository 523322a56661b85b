"""What every registered optimizer promises, and what ours promise beyond that."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.testing import OptimizerContract
from hysteresis_bench.testing.examples import Plateau, Waves
from hysteresis_bench.testing.meter import watch

OURS = tuple(
    name
    for name in registry.names("optimizers")
    if registry.load("optimizers", name).distribution == "hysteresis-bench"
)
DETERMINISTIC = {"nlopt-direct-l", "scipy-direct", "scipy-shgo"}


class TestOptimizers(OptimizerContract):
    plugin = OURS


@pytest.mark.parametrize("budget", [1, 7, 60, 517])
@pytest.mark.parametrize("name", OURS)
def test_it_does_not_end_early_on_so_small_a_budget(name, budget):
    found = watch(registry.build("optimizers", name), Waves(5), budget)
    assert found.evaluations == budget or found.trace.losses[-1] < 1e-9, "it ends early with an optimum in hand only"


@pytest.mark.parametrize("name", sorted(set(OURS) - DETERMINISTIC))
def test_other_seed_other_search(name):
    one, other = (watch(registry.build("optimizers", name), Waves(5), 60, seed) for seed in (0, 1))
    assert not np.array_equal(one.points, other.points)


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("name", [name for name in OURS if name.startswith("nlopt")])
def test_nlopt_unwinds_wherever_the_budget_ends(name, dimension):
    # a refusal raised through nlopt becomes a SystemError where BOBYQA would have finished on that evaluation
    for budget in range(1, 41):
        run = watch(registry.build("optimizers", name), Plateau(dimension, 3.0), budget)
        assert run.spent
        assert run.evaluations == budget
        assert run.refusals == 1


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("pso", {"particles": 0}),
        ("pso", {"speed_limit": 0.0}),
        ("mpso", {"mutation_threshold": 1.5}),
        ("mpso", {"inertia_first": 0.3}),
        ("pso-constriction", {"attraction": 4.0}),
        ("scipy-differential-evolution", {"particles": 4}),
        ("scipy-differential-evolution", {"mutation_low": 1.2}),
        ("scipy-dual-annealing", {"accept": 1.0}),
        ("nlopt-bobyqa", {"tolerance": 0.0}),
        ("pymoo-cmaes", {"spread": float("nan")}),
    ],
)
def test_wrong_settings_are_told(name, settings):
    with pytest.raises(ValueError, match=next(iter(settings))):
        registry.build("optimizers", name, settings)

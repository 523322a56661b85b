"""What every registered optimizer promises: the exact budget, the box, its seed, and an end on any landscape."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from functools import cache

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model, Optimizer
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import BudgetSpent, Objective, Problem, Trace
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record

# all but those that break a promise on purpose, to test what becomes of them
NAMES = [
    name
    for name in registry.names("optimizers")
    if registry.load("optimizers", name).distribution != "hysteresis-test-plugins"
]
OURS = [name for name in NAMES if registry.load("optimizers", name).distribution == "hysteresis-bench"]
DETERMINISTIC = {"nlopt-direct-l", "scipy-direct", "scipy-shgo"}
TRUTH = np.array([0.31, 0.72, 0.55, 0.13, 0.88])
TIME = np.linspace(0.0, 1.0, 16)


class Waves(Model):
    """A sum of sines whose amplitudes are the parameters, squared: smooth, cheap, and one minimum in the box."""

    def __init__(self, dimension: int) -> None:
        self.parameters = tuple(Parameter(f"a{i}", 0.0, 1.0) for i in range(dimension))  # type: ignore[misc]

    def simulate(self, signal, p):
        values = np.array(p)
        waves = np.sin(np.outer(signal.time, 1.0 + np.arange(len(values))) * 2.0)
        return waves @ (values + values**2)


class Plateau(Model):
    """The same output everywhere; NaN makes the meter answer its ceiling."""

    def __init__(self, dimension: int, level: float) -> None:
        self.parameters = tuple(Parameter(f"a{i}", 0.0, 1.0) for i in range(dimension))  # type: ignore[misc]
        self.level = level

    def simulate(self, signal, p):
        return np.full((signal.time.size, p[0].size), self.level)


@dataclass
class Watched:
    """The real meter behind a second, independent count, and every point that passed it."""

    meter: Objective
    asked: int = 0
    refusals: int = 0
    points: list[np.ndarray] = field(default_factory=list)

    @property
    def dimension(self) -> int:
        return self.meter.dimension

    @property
    def budget(self) -> int:
        return self.meter.budget

    @property
    def evaluations(self) -> int:
        return self.meter.evaluations

    def __call__(self, point):
        return self._pass(self.meter, point)

    def many(self, points):
        return self._pass(self.meter.many, points)

    def residuals(self, point):
        return self._pass(self.meter.residuals, point)

    def _pass(self, question, points):
        columns = np.array(points, dtype=float).reshape(self.dimension, -1)
        self.points.append(columns[:, : self.meter.budget - self.meter.evaluations])
        self.asked += columns.shape[1]
        try:
            return question(points)
        except BudgetSpent:
            self.refusals += 1
            raise


@dataclass(frozen=True)
class Outcome:
    trace: Trace
    points: np.ndarray
    evaluations: int
    asked: int
    refusals: int
    spent: bool


def problem(model: Model) -> Problem:
    size = len(model.parameters)
    output = Waves(size).simulate(Record(TIME, TIME, None).signal, TRUTH[:size, None])[:, 0]
    return Problem(System(model), (Record(TIME, TIME, output),), Space(model.parameters), LOSSES["rmse"])


def outcome(name: str, model: Model, budget: int, seed: int = 0) -> Outcome:
    optimizer = registry.build("optimizers", name)
    objective = Watched(Objective(problem(model), budget))
    first = np.random.default_rng([seed, 1]).random((max(budget, 100), objective.dimension)).T
    try:
        optimizer.search(objective, lambda particles: first[:, :particles].copy(), np.random.default_rng([seed, 2]))
        spent = False
    except BudgetSpent:
        spent = True
    points = np.concatenate([*objective.points, np.empty((objective.dimension, 0))], axis=1)
    trace = objective.meter.trace
    return Outcome(trace, points, objective.evaluations, objective.asked, objective.refusals, spent)


@cache
def smooth(name: str, budget: int, seed: int = 0, dimension: int = 5) -> Outcome:
    return outcome(name, Waves(dimension), budget, seed)


@pytest.mark.parametrize("name", NAMES)
def test_loads_and_is_an_optimizer(name):
    plugin = registry.load("optimizers", name)
    assert plugin.fault == ""
    assert issubclass(plugin.loaded, Optimizer)
    assert plugin.summary.endswith(".")


@pytest.mark.parametrize("budget", [1, 7, 60, 517])
@pytest.mark.parametrize("name", NAMES)
def test_spends_its_budget_exactly_or_ends_early(name, budget):
    run = smooth(name, budget)
    assert run.evaluations == run.points.shape[1]
    assert run.evaluations <= budget
    assert run.evaluations == budget or not run.spent
    # the refusal unwinds at once: the search asks nothing after it
    assert run.refusals == run.spent
    # others may stop for lack of ideas; ours do not on so small a budget
    assert run.spent or name not in OURS


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("name", NAMES)
def test_works_in_few_dimensions(name, dimension):
    run = smooth(name, 150, dimension=dimension)
    assert run.evaluations == 150 or not run.spent
    assert run.trace.losses[-1] < run.trace.losses[0]


@pytest.mark.parametrize("name", NAMES)
def test_stays_in_the_box(name):
    # the meter raises OutsideBox otherwise; this is the independent look
    points = smooth(name, 517).points
    assert np.all((points >= 0.0) & (points <= 1.0))


@pytest.mark.parametrize("name", NAMES)
def test_same_seed_same_search(name):
    first, second = smooth(name, 517), outcome(name, Waves(5), 517)
    assert np.array_equal(first.points, second.points)
    assert np.array_equal(first.trace.evaluations, second.trace.evaluations)
    assert np.array_equal(first.trace.losses, second.trace.losses)
    assert np.array_equal(first.trace.points, second.trace.points)


@pytest.mark.parametrize("name", sorted(set(OURS) - DETERMINISTIC))
def test_other_seed_other_search(name):
    assert not np.array_equal(smooth(name, 60).points, smooth(name, 60, seed=1).points)


@pytest.mark.parametrize("level", [3.0, np.nan], ids=["constant", "ceiling"])
@pytest.mark.parametrize("name", NAMES)
def test_ends_on_a_plateau(name, level):
    run = outcome(name, Plateau(3, level), 400)
    assert run.evaluations == 400 or not run.spent
    assert run.evaluations > 0
    assert run.trace.losses.size == 1


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("name", [name for name in NAMES if name.startswith("nlopt")])
def test_nlopt_unwinds_wherever_the_budget_ends(name, dimension):
    # a refusal raised through nlopt becomes a SystemError where BOBYQA would have finished on that evaluation
    for budget in range(1, 41):
        run = outcome(name, Plateau(dimension, 3.0), budget)
        assert run.spent
        assert run.evaluations == budget
        assert run.refusals == 1


@pytest.mark.parametrize("name", NAMES)
def test_leaves_global_and_shared_state_alone(name):
    before = np.random.get_state()[1].copy()  # noqa: NPY002
    objective = Objective(problem(Waves(3)), 120)
    shared = np.random.default_rng(5).random((200, 3)).T
    kept = shared.copy()
    with contextlib.suppress(BudgetSpent):
        registry.build("optimizers", name).search(objective, lambda n: shared[:, :n], np.random.default_rng(6))
    assert np.array_equal(shared, kept)
    assert np.array_equal(np.random.get_state()[1], before)  # noqa: NPY002


@pytest.mark.parametrize("name", NAMES)
def test_iterations_cost_what_they_claim(name):
    cost = registry.build("optimizers", name).evaluations_per_iteration(5)
    assert cost is None or (isinstance(cost, int) and cost >= 1)


@pytest.mark.parametrize("name", [name for name in NAMES if name.startswith(("scipy", "nlopt", "pymoo"))])
def test_an_error_in_the_objective_comes_through(name):
    class Broken(Waves):
        def simulate(self, signal, p):
            raise ArithmeticError("the model broke")

    with pytest.raises((ArithmeticError, RuntimeError)) as caught:
        outcome(name, Broken(2), 50)
    assert "the model broke" in f"{caught.value} {caught.value.__cause__} {caught.value.__context__}"


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

"""Multistart least squares: known truths are found for few evaluations, and nothing stops it before it should."""

from dataclasses import dataclass

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, shared_start
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 1.0, 1500)
DRIVE = 3.0 * (np.sin(19.0 * TIME) + 0.5 * np.sin(46.0 * TIME)) / 1.4
BUDGET = 15_050


def problem(name: str, truth: dict[str, float], noise: float, drive: np.ndarray = DRIVE) -> tuple[Problem, np.ndarray]:
    system = System(registry.build("models", name))
    values = np.array([[truth[q.name]] for q in system.parameters])
    clean = system.simulate(Record(TIME, drive, None).signal, values)[:, 0]
    output = clean + noise * np.std(clean) * np.random.default_rng(4).standard_normal(TIME.size)
    record = Record(TIME, drive, output)
    posed = Problem(system, (record,), Space(system.box([record])), LOSSES["rmse"])
    return posed, posed.space.to_unit(values)


def found(posed: Problem, seed: int = 0, budget: int = BUDGET, **settings):
    built = registry.build("optimizers", "multistart-least-squares", settings)
    start = shared_start(posed.space.dimension, seed)
    return search(posed, built, budget=budget, start=start, rng=generator(seed))


BOUC_WEN = {"alpha": 0.5, "beta": 0.9, "gamma": -0.3, "d": 2.0}
JILES_ATHERTON = {"alpha": 2e-3, "a": 900.0, "k": 700.0, "M_s": 1.2e6, "c": 0.2}


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(
    ("name", "truth", "amplitude"), [("bouc-wen", BOUC_WEN, 1.0), ("jiles-atherton", JILES_ATHERTON, 1000.0)]
)
def test_it_ends_at_the_floor_for_few_evaluations(name, truth, amplitude, seed):
    posed, true = problem(name, truth, 0.01, amplitude * DRIVE)
    best = found(posed, seed)
    assert best.loss < 1.0001 * posed.losses(true)[0]
    assert not best.spent
    assert best.evaluations < 3000


def test_noise_free_data_end_it_too():
    posed, _ = problem("bouc-wen", BOUC_WEN, 0.0)
    best = found(posed)
    assert best.loss < 1e-8 * posed.scale
    assert best.evaluations < 3000


@dataclass(frozen=True)
class Rays(Model):
    """Linear in all of its parameters."""

    parameters = tuple(Parameter(name, -5.0, 5.0) for name in ("a", "b", "c"))
    linear = ("a", "b", "c")

    def simulate(self, signal, p):
        u = signal.input[:, :1]
        return p.a + p.b * u + p.c * u**2


@dataclass(frozen=True)
class Void(Rays):
    """Nothing can be simulated anywhere."""

    linear = ()

    def simulate(self, signal, p):
        return np.full((signal.input.shape[0], p.a.size), np.nan)


def of(model: Model, output: np.ndarray) -> Problem:
    record = Record(TIME, DRIVE, output)
    return Problem(System(model), (record,), Space(model.parameters), LOSSES["rmse"])


def test_where_all_is_linear_a_handful_of_simulations_is_enough():
    rng = np.random.default_rng(2)
    noise = rng.standard_normal(TIME.size)
    posed = of(Rays(), 1.0 - 2.0 * DRIVE + 6.0 * DRIVE**2 + noise)  # 6 lies outside the box
    best = found(posed)
    assert best.evaluations < 200  # two rounds; how often a step at the optimum is tried again is rounding
    assert best.values[2] == pytest.approx(5.0)
    columns = np.column_stack([np.ones(TIME.size), DRIVE])
    expected = np.linalg.lstsq(columns, posed.records[0].measured - 5.0 * DRIVE**2, rcond=None)[0]
    assert best.values[:2] == pytest.approx(expected, rel=1e-6)


def test_a_box_of_nothing_costs_the_budget_and_no_more():
    best = found(of(Void(), DRIVE), budget=700)
    assert best.spent
    assert np.isfinite(best.loss)


@pytest.mark.parametrize("settings", [{"points": 0}, {"descents": 0}, {"finished": 0}])
def test_settings_are_told(settings):
    with pytest.raises(ValueError, match=next(iter(settings))):
        registry.build("optimizers", "multistart-least-squares", settings)

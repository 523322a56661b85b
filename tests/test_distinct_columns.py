"""What a swarm has several times is simulated once, and nothing else changes."""

import numpy as np
import pytest

from hysteresis_bench import compose, registry
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.least_squares import jacobian
from hysteresis_bench.kernels.distinct_columns import distinct_columns
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 4.0, 240)
DRIVE = np.sin(2.0 * np.pi * TIME) * np.linspace(0.3, 1.0, TIME.size)
RECORD = Record(TIME, DRIVE, DRIVE + 0.2 * np.sign(np.cos(2.0 * np.pi * TIME)))


@pytest.mark.parametrize("swarm", [1, 2, 7, 64])
def test_distinct_columns_make_up_all_of_them(swarm):
    columns = np.random.default_rng(swarm).integers(0, 3, (2, swarm)).astype(float)
    rows = np.arange(2)
    first, place = distinct_columns(columns, rows)
    assert np.array_equal(columns[:, first][:, place], columns)
    repeated = np.repeat(columns, 2, axis=1)
    first, place = distinct_columns(repeated, rows)
    assert first.size == np.unique(columns, axis=1).shape[1]
    assert np.array_equal(repeated[:, first][:, place], repeated)
    first, place = distinct_columns(repeated, rows[:1])
    assert np.array_equal(repeated[:1, first][:, place], repeated[:1])


@pytest.mark.parametrize("law", ["jiles-atherton", "lugre", "prandtl-ishlinskii"])
@pytest.mark.parametrize(
    "names",
    [
        ["creep", "drift", "record-offset"],
        ["asymmetry", "output-curve", "saturation"],
        ["lags-before", "lags-after", "record-drift"],
        ["rayleigh-hysteresis", "backlash", "fatigue", "periodic-disturbance"],
    ],
    ids="+".join,
)
def test_a_jacobian_keeps_every_bit(law, names, monkeypatch):
    problem = Stack(registry.build("models", law, {}), (RECORD,)).problem(names)
    points = 0.2 + 0.6 * np.random.default_rng(0).random((problem.space.dimension, 3))
    found = jacobian(problem, points)
    monkeypatch.setattr(compose, "MOSTLY", -1.0)
    for one, other in zip(found, jacobian(problem, points), strict=True):
        assert np.array_equal(one, other)


def test_the_law_answers_an_effects_differences_once(monkeypatch):
    model = registry.build("models", "jiles-atherton", {})
    widths = []
    simulate = type(model).simulate

    def counted(self, signal, p):
        widths.append(p[0].size)
        return simulate(self, signal, p)

    monkeypatch.setattr(type(model), "simulate", counted)
    problem = Stack(model, (RECORD,)).problem(["creep", "drift", "output-curve"])
    jacobian(problem, np.full((problem.space.dimension, 2), 0.4))
    assert max(widths) == 1 + len(model.parameters)

"""Noise-free Jiles-Atherton data in the paper's box on a log scale: what is recovered, and how well."""

import pytest

from hysteresis_bench import registry
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, shared_start
from hysteresis_bench.study.problems import build_problem
from hysteresis_bench.study.study_file import ProblemSpec
from hysteresis_plugins.rigs.sma_known_truth import TRUTH

BOX = {"alpha": (1e-14, 1e-2), "a": (1e-2, 1e4), "k": (1e-2, 1e4), "M_s": (1e5, 3e7), "c": (1e-2, 3.0)}


def found(optimizer, scaling):
    spec = ProblemSpec(
        name="truth", rig="sma-known-truth", fitted=["pwm-60s"], model="jiles-atherton", scaling=scaling, bounds=BOX
    )
    built = build_problem(spec, 1, None)
    start = shared_start(5, "golden", optimizer)
    rng = generator("golden", optimizer)
    result = search(built.problem, registry.build("optimizers", optimizer), budget=15050, start=start, rng=rng)
    return result.values, accuracy(built.problem.system, built.dataset.fitted, result.values).relative_rms


def test_least_squares_recovers_it_to_a_millionth():
    values, relative_rms = found("scipy-least-squares", "log")
    assert relative_rms < 1e-6
    assert values == pytest.approx(list(TRUTH.values()), rel=1e-4)


@pytest.mark.parametrize(("optimizer", "within"), [("mpso", 0.05), ("pso-constriction", 0.02)])
def test_the_swarms_come_close(optimizer, within):
    assert found(optimizer, "log")[1] < within

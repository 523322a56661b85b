"""An effect is not tried around a law whose own equation says the same."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.checks.redundant import is_redundant
from hysteresis_bench.signals import Record

LINEAR = ("cubic-stiffness", "viscous-damping", "drift")
SAID = {("lugre", "viscous-damping"), ("preisach", "cubic-stiffness")}
"""LuGre's sigma_2 v; the third power of the input itself, of a play without a threshold."""


def records() -> tuple[Record, ...]:
    made = []
    for amplitude, frequency in ((1.0, 1.0), (1.7, 3.0)):
        time = np.linspace(0.0, 2.0, 300)
        u = amplitude * np.sin(2.0 * np.pi * frequency * time) * np.minimum(1.0, time)
        made.append(Record(time, u, u + 0.2 * np.tanh(u), name=f"{amplitude}"))
    return tuple(made)


@pytest.mark.parametrize("effect", LINEAR)
@pytest.mark.parametrize("law", ["lugre", "preisach", "bouc-wen", "dahl", "prandtl-ishlinskii", "jiles-atherton"])
def test_what_a_law_says_already(law, effect):
    problem = Stack(registry.build("models", law, {}), records()).problem([effect])
    assert is_redundant(problem, effect) == ((law, effect) in SAID)


def test_a_law_whose_force_of_the_rate_is_known_says_no_other():
    stack = Stack(registry.build("models", "lugre", {}), records(), fixed={"sigma_2": 0.0})
    assert not is_redundant(stack.problem(["viscous-damping"]), "viscous-damping")


def test_an_effect_with_a_parameter_that_is_not_linear_is_asked_about_by_the_fit():
    problem = Stack(registry.build("models", "lugre", {}), records()).problem(["output-lag"])
    assert not is_redundant(problem, "output-lag")


def test_it_is_no_candidate_and_the_reason_is_told():
    possible, impossible = Stack(registry.build("models", "lugre", {}), records()).candidates()
    assert "viscous-damping" not in possible
    assert "adds the same already" in impossible["viscous-damping"]

"""Which experiment tells fitted systems apart, where some are the same whatever is played."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.findings.advice import advise
from hysteresis_bench.signals import Record

TIME = np.arange(800) / 200.0
RECORDS = [Record(TIME, 3.0 * np.sin(2 * np.pi * TIME), 6.0 * np.sin(2 * np.pi * TIME))]
NAMES = ["input-lag", "output-lag", "transport-delay"]


def fitted(effect, alpha):
    """Bouc-Wen with one effect that makes it late by 20 ms."""
    model = registry.build("models", "bouc-wen")
    system = System(model, registry.build_effects(model, (effect,), {}))
    return system, np.array([alpha, 0.6, 0.2, 1.7, 0.02])


def advice_on(alpha, *names):
    first, *others = [fitted(name, alpha) for name in names]
    return advise(first, others, RECORDS, 0.01, names)


def test_two_lags_around_a_straight_line_are_the_same():
    """Without hysteresis they commute; a delay is told from a lag at high frequency."""
    found = advice_on(0.0, *NAMES)
    assert "No feasible signal tells input-lag and output-lag apart" in found.words
    assert "To tell input-lag and transport-delay apart, measure" in found.words
    assert found.experiment in found.words
    assert found.separation > 3 * found.noise


def test_where_all_are_the_same_there_is_no_experiment():
    found = advice_on(0.0, *NAMES[:2])
    assert found.experiment == ""
    assert found.separation == pytest.approx(0.0, abs=1e-6)
    assert found.words.startswith("No feasible signal tells input-lag and output-lag apart")


def test_around_a_loop_they_are_three():
    found = advice_on(0.3, *NAMES)
    assert found.experiment
    assert found.words.startswith("To tell input-lag, output-lag and transport-delay apart")
    assert "No feasible signal" not in found.words

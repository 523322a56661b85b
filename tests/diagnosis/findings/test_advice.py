"""Which experiment tells fitted systems apart, where some are the same whatever is played."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.experiments.power import Fitted, Left
from hysteresis_bench.diagnosis.findings.advice import advise
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

TIME = np.arange(800) / 200.0
RECORDS = (Record(TIME, 3.0 * np.sin(2 * np.pi * TIME), 6.0 * np.sin(2 * np.pi * TIME)),)
NAMES = ["input-lag", "output-lag", "transport-delay"]


def fitted(effect, alpha):
    """Bouc-Wen with one effect that makes it late by 20 ms."""
    model = registry.build("models", "bouc-wen")
    system = System(model, registry.build_effects(model, (effect,), {}))
    problem = Problem(system, RECORDS, Space(system.box(RECORDS)), LOSSES["rmse"])
    return Fitted(problem, np.array([alpha, 0.6, 0.2, 1.7, 0.02]))


def advice_on(alpha, *names, noise=0.01, **more):
    return advise({name: fitted(name, alpha) for name in names}, RECORDS, noise, **more)


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


def test_the_expected_probability_falls_with_the_noise_and_is_told():
    quiet, loud, deaf = (advice_on(0.3, *NAMES, noise=noise) for noise in (0.01, 0.6, 60.0))
    assert quiet.experiment == loud.experiment == deaf.experiment
    assert set(quiet.probabilities) == set(NAMES[1:])
    least = [min(one.probabilities.values()) for one in (quiet, loud, deaf)]
    assert least[0] > 0.99 > least[1] > least[2]
    assert least[2] < 0.05
    assert "settles that with an expected probability of more than 99%" in quiet.words
    assert "a faster or more precise rig" in deaf.words
    assert advice_on(0.3, *NAMES, left=Left(0.6)).probabilities == loud.probabilities


def test_the_drive_is_the_devices_input_sampled_as_the_records_are():
    seen = advice_on(0.3, *NAMES).drive
    device = advice_on(0.3, *NAMES, preparation=Preparation(input_offset=10.0, flip=True)).drive
    assert seen.output is None
    assert np.ptp(seen.input) == pytest.approx(6.0, rel=0.05)
    assert device.input == pytest.approx(10.0 - seen.input)
    assert np.diff(seen.time) == pytest.approx(1.0 / 200.0, rel=0.02)
    assert "between 7 and 13" in advice_on(0.3, *NAMES, preparation=Preparation(10.0, True)).words

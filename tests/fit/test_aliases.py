"""A hum beyond half the sampling rate is known by its alias: predictions of other samples are doubted, no others."""

import numpy as np
import pytest

from hysteresis_bench import FitOptions, fit
from hysteresis_bench.fit.unseen.aliases import alias_told
from hysteresis_bench.signals import Dataset, Record

STEP = 0.01
HUM = 1.0 / STEP + 7.0
"""Seen every 10 ms it has 7 cycles a second."""


def measured(step: float, phase: float = 0.0) -> Record:
    time = np.arange(round(4.0 / step)) * step
    u = np.sin(2.0 * np.pi * time) * np.minimum(time, 1.0) + 0.3 * np.sin(5.0 * time + phase) - 0.3 * np.sin(phase)
    noise = 0.003 * np.random.default_rng(len(time)).standard_normal(time.size)
    return Record(time, u, 1.5 * u + 0.1 * np.sin(2.0 * np.pi * HUM * time) + noise, f"steps of {step:g}")


@pytest.fixture(scope="module")
def model():
    options = FitOptions(budget=3000)
    return fit(Dataset((measured(STEP),)), "dahl", ("periodic-disturbance",), options=options).model


@pytest.mark.parametrize(("step", "times"), [(STEP, ""), (3.0 * STEP, ""), (0.2 * STEP, "0.2"), (2.5 * STEP, "2.5")])
def test_a_prediction_of_other_samples_is_doubted(model, step, times):
    record = measured(step)
    predicted = model.predict(Dataset((record,)))
    told = [note for note in predicted.notes if "alias" in note]
    assert len(told) == bool(times)
    assert all(f"record {record.name}: its samples are {times} times as far apart" in note for note in told)
    rmse = np.sqrt(np.mean((predicted.records[0].output - record.output) ** 2))
    assert rmse > 0.05 if times else rmse < 0.004


def test_where_fitted_records_were_sampled_otherwise_or_nothing_hums_nothing_is_said(model):
    fine = measured(0.2 * STEP)
    assert model.data["steps"] == pytest.approx([STEP, STEP])
    assert not alias_told(model.system, [STEP, 1.3 * STEP], fine)
    assert not alias_told(
        fit(Dataset((measured(STEP),)), "dahl", options=FitOptions(budget=300)).model.system, [STEP, STEP], fine
    )


@pytest.mark.parametrize("kept", [None, [], "0.01", [0.01], [0.0, 0.01], ["a", "b"], {"least": 0.01}])
def test_a_file_that_does_not_tell_the_steps_is_no_fault(model, kept):
    assert alias_told(model.system, kept, measured(0.2 * STEP)) == ""

"""Data that need no hysteresis: it is switched off in the model, and what then does nothing is not fitted."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.without_hysteresis import without_hysteresis
from hysteresis_bench.signals import Dataset, Record

DELAY, GAIN, SAMPLES = 0.004, 1.5, 400


def triangle(phase):
    """Between -1 and 1, from 0, with slopes of 4 a period."""
    return 1.0 - np.abs((4.0 * phase - 1.0) % 4.0 - 2.0)


def late_lines(cycles=1, noise=0.001):
    """A gain and a delay, at three frequencies."""
    rng = np.random.default_rng(1)
    records = []
    for frequency in (1.0, 4.0, 2.0):
        time = np.arange(cycles * SAMPLES) / (SAMPLES * frequency)
        drive, late = (5.0 * triangle(np.maximum(time - by, 0.0) * frequency) for by in (0.0, DELAY))
        output = GAIN * late + noise * 10.0 * GAIN * rng.standard_normal(time.size)
        records.append(Record(time, drive, output, f"{frequency:g} Hz"))
    return Dataset(tuple(records))


def test_bouc_wen_without_alpha_has_one_parameter_left():
    records = late_lines().records
    model = registry.build("models", "bouc-wen")
    off = without_hysteresis(model, records)
    assert set(off) == {"alpha", "beta", "gamma"}
    assert off["alpha"] == 0.0
    rest = System(model, fixed=off)
    assert [parameter.name for parameter in rest.parameters] == ["d"]
    whatever = System(model, fixed={"alpha": 0.0, "beta": 3.0, "gamma": -1.0})
    for system in (rest, whatever):
        assert np.allclose(system.simulate(records[0].signal, np.array([[2.0]]))[:, 0], 2.0 * records[0].input)


def test_a_model_that_cannot_do_without():
    assert without_hysteresis(registry.build("models", "jiles-atherton"), late_lines().records) == {}


def test_a_linear_device_with_a_delay():
    found = diagnose(late_lines(), Question("bouc-wen"), jobs=1)
    assert not found.memory.needed
    assert found.verdict == "effect-found"
    names = {*found.effects, *(one.rival for one in found.ties)}
    assert "transport-delay" in names
    assert len(found.effects) == 1
    assert found.model.fixed["alpha"] == 0.0
    values = {name: estimate.value for name, estimate in found.model.parameters.items()}
    assert values["d"] == pytest.approx(GAIN, rel=0.01)
    if found.effects == ("transport-delay",):
        assert values["transport-delay.delay"] == pytest.approx(DELAY, rel=0.03)

"""The boxes of effects, and why one would not apply."""

import numpy as np
import pytest

from hysteresis_bench.signals import INDEX
from tests.plugins.around import DRIVE, TIME, against, applied, box, record

RATE = ["input-lag", "output-lag", "transport-delay", "creep", "droop", "drift", "periodic-disturbance"]
STATIC = ["saturation", "asymmetry", "backlash", "fatigue"]


def test_without_a_temperature_it_says_so():
    with pytest.raises(ValueError, match="column temperature"):
        applied("temperature-sensitivity", record().signal, gain=0.0, expansion=0.0)


def test_boxes_follow_the_data():
    data = record()
    assert box("drift", data)["rate"] == pytest.approx((-3.0, 3.0), rel=1e-3)  # 12 in 4 s
    assert box("backlash", data)["half_width"] == pytest.approx((0.0, 2.4), rel=1e-3)
    assert box("saturation", data)["inverse_level"] == pytest.approx((0.0, 1 / 3.6), rel=1e-3)
    assert box("asymmetry", data)["curvature"] == pytest.approx((-0.45 / 3.5, 0.45 / 3.5), rel=1e-3)
    assert box("fatigue", data)["rate"] == pytest.approx((0.0, 3.0 / 48.0), rel=1e-3)  # four cycles of 12
    assert box("transport-delay", data)["delay"] == pytest.approx((2e-4, 0.5), rel=1e-2)  # half a period
    for name in ("input-lag", "output-lag"):
        assert box(name, data)["time_constant"] == pytest.approx((2e-4, 4.0), rel=1e-6)
    assert box("periodic-disturbance", data)["frequency"] == pytest.approx((0.75, 50.0), rel=1e-6)


@pytest.mark.parametrize("name", RATE)
def test_an_index_is_no_time(name):
    assert "only an index" in against(name, record(units={"time": INDEX, "input": "V", "output": "um"}))


@pytest.mark.parametrize("name", [*STATIC, "stop-above", "stop-below"])
def test_an_index_is_enough_for_what_has_no_rate(name):
    assert against(name, record(units={"time": INDEX, "input": "V", "output": "um"})) == ""


@pytest.mark.parametrize("name", [*RATE[:4], *STATIC[1:]])
def test_an_input_that_never_moves_tells_nothing(name):
    assert against(name, record(drive=np.ones(TIME.size))) == "the input never moves"


@pytest.mark.parametrize("name", ["saturation", "stop-above", "stop-below"])
def test_an_output_that_never_moves_cannot_saturate(name):
    assert against(name, record(output=np.ones(TIME.size))) == "the output never moves"


@pytest.mark.parametrize("name", RATE[:4])
def test_coarse_and_short_records_do_not_resolve_a_lag(name):
    coarse = slice(None, None, 33)  # three samples a cycle
    assert "too coarse" in against(name, record(TIME[coarse], DRIVE[coarse]))
    assert against(name, record(TIME[:5], DRIVE[:5])) == "no record has 8 samples"


def test_one_loop_does_not_tell_fatigue():
    assert "less than four times" in against("fatigue", record(TIME[:101], DRIVE[:101]))


def test_passes_of_a_loop_that_had_settled_do_not_tell_fatigue():
    loop = record(TIME[:101], DRIVE[:101])
    assert "less than four times" in against("fatigue", loop.settled(8))
    assert "less than four times" in against("gain-with-path", loop.settled(8))


def test_too_few_samples_have_no_spectrum():
    assert against("periodic-disturbance", record(TIME[:9], DRIVE[:9])) == "no record has 12 samples"


@pytest.mark.parametrize(
    ("columns", "reason"),
    [
        ({}, "record warm has no column temperature with a number in every row"),
        ({"temperature": np.full(TIME.size, 25.0)}, "the temperature never changes"),
        ({"temperature": np.full(TIME.size, np.nan)}, "the temperature is not known at every sample"),
    ],
)
def test_temperature_has_to_be_known_and_to_change(columns, reason):
    assert against("temperature-sensitivity", record(name="warm", columns=columns)) == reason


def test_one_frequency_does_not_tell_a_resonance():
    sine, slower = record(), record(drive=3.0 * np.sin(np.pi * TIME))
    shrinking = record(drive=DRIVE * (6.5 - TIME))
    triangle = record(drive=3.0 * np.arcsin(np.sin(2 * np.pi * TIME)))
    assert "one frequency" in against("resonance", sine, shrinking)
    assert against("resonance", sine, slower) == against("resonance", triangle) == ""

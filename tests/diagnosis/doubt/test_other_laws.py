"""Other laws are fitted with the effects that were found around the asked one, and begin where these ended."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.doubt.other_laws import OtherLaws
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.signals import Record

HUM = "periodic-disturbance"
TIME = np.linspace(0.0, 100.0, 3000)


def output(late=0.0):
    """Of Dahl's law, to an input that comes so many seconds late, and that input; (samples,) each."""
    model = registry.build("models", "dahl")
    values = np.array([model.example.parameters[p.name] for p in model.parameters])[:, None]
    drive, late = (model.example.amplitude * np.sin(1.3 * np.pi * t) * (0.5 + 0.005 * t) for t in (TIME, TIME - late))
    return System(model).simulate(Record(TIME, late, None).signal, values)[:, 0], drive


def around(clean, drive, added, effects):
    """Other laws around one record, with noise; and the noise's RMS."""
    noise = 0.003 * np.ptp(clean)
    measured = clean + added + noise * np.random.default_rng(5).standard_normal(TIME.size)
    records = (Record(TIME, drive, measured),)
    stack = Stack(registry.build("models", "bouc-wen"), records)
    return OtherLaws("bouc-wen", stack, records, effects, noise, 0, {}), noise


def test_a_narrow_line_of_the_spectrum_is_found_around_every_law():
    clean, drive = output()
    height = 0.03 * np.ptp(clean)
    laws, noise = around(clean, drive, height * np.sin(2 * np.pi * 11.37 * TIME), (HUM,))
    known = {f"{HUM}.cosine": 0.0, f"{HUM}.sine": height, f"{HUM}.frequency": 11.37}
    assert laws.screened("dahl").rmse > 1.5 * noise
    assert replace(laws, values=known).screened("dahl").rmse < 1.05 * noise


@pytest.mark.parametrize(
    ("late", "slope", "effects", "kept"),
    [
        (0.0, 0.002, ("drift", "stop-above", "stop-below"), [("drift",)]),
        (0.0, 0.0, ("drift", "stop-above", "output-lag"), [()]),
        # neither is missed beside the other, both together are
        (0.02, 0.0, ("input-lag", "stop-above", "transport-delay"), [("input-lag",), ("transport-delay",)]),
    ],
)
def test_what_is_not_needed_leaves_and_what_is_missed_stays(late, slope, effects, kept):
    clean, drive = output(late)
    laws, noise = around(clean, drive, slope * np.ptp(clean) * TIME, effects)
    found = laws.needy("dahl")
    assert found.effects in kept
    assert found.rmse < 1.05 * noise

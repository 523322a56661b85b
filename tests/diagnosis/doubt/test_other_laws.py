"""Other laws are fitted with the effects that were found around the asked one, and begin where these ended."""

from dataclasses import replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.doubt.other_laws import OtherLaws
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.signals import Record

HUM = "periodic-disturbance"


def test_a_narrow_line_of_the_spectrum_is_found_around_every_law():
    time, rng = np.linspace(0.0, 100.0, 3000), np.random.default_rng(5)
    model = registry.build("models", "dahl")
    values = np.array([model.example.parameters[p.name] for p in model.parameters])[:, None]
    drive = model.example.amplitude * np.sin(1.3 * np.pi * time) * (0.5 + 0.005 * time)
    clean = System(model).simulate(Record(time, drive, None).signal, values)[:, 0]
    noise = 0.003 * np.ptp(clean)
    measured = clean + 0.03 * np.ptp(clean) * np.sin(2 * np.pi * 11.37 * time) + noise * rng.standard_normal(time.size)
    records = (Record(time, drive, measured),)
    known = {f"{HUM}.cosine": 0.0, f"{HUM}.sine": 0.03 * np.ptp(clean), f"{HUM}.frequency": 11.37}
    around = OtherLaws("bouc-wen", Stack(registry.build("models", "bouc-wen"), records), records, (HUM,), noise, 0, {})
    assert around.screened("dahl").rmse > 1.5 * noise
    assert replace(around, values=known).screened("dahl").rmse < 1.05 * noise

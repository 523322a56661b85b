"""Thin loops and no loop: nothing is switched off, and nothing is named to rebuild what the model already has."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.signals import Dataset, Record

DELAY, GAIN, SAMPLES = 0.004, 1.5, 400


def triangle(phase):
    """Between -1 and 1, from 0, with slopes of 4 a period."""
    return 1.0 - np.abs((4.0 * phase - 1.0) % 4.0 - 2.0)


def late_lines(noise=0.001):
    """A gain and a delay, at three frequencies."""
    rng = np.random.default_rng(1)
    records = []
    for frequency in (1.0, 4.0, 2.0):
        time = np.arange(SAMPLES) / (SAMPLES * frequency)
        drive, late = (5.0 * triangle(np.maximum(time - by, 0.0) * frequency) for by in (0.0, DELAY))
        output = GAIN * late + noise * 10.0 * GAIN * rng.standard_normal(time.size)
        records.append(Record(time, drive, output, f"{frequency:g} Hz"))
    return Dataset(tuple(records))


def thin_loops(alpha, noise, seed):
    """Bouc-Wen loops that are hardly open, and the RMS of their noise."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0.0, 3.0, 900)
    drives = {
        "decaying": 4.0 * np.sin(2 * np.pi * time) * (1.0 - 0.2 * time),
        "nested": 2.8 * np.sin(1.2 * np.pi * time) + 1.2 * np.sin(4.2 * np.pi * time),
        "swelling": 4.0 * np.sin(3 * np.pi * time) * (0.4 + 0.2 * time),
        "unseen": 1.6 * np.sin(1.4 * np.pi * time) + 2.0 * np.sin(3.2 * np.pi * time),
    }
    system = System(registry.build("models", "bouc-wen"))
    values = np.array([[alpha], [0.7], [0.15], [1.2]])
    outputs = {name: system.simulate(Record(time, u, None).signal, values)[:, 0] for name, u in drives.items()}
    rms = noise * np.ptp(outputs["decaying"])
    records = [Record(time, u, outputs[name] + rms * rng.standard_normal(900), name) for name, u in drives.items()]
    return Dataset(tuple(records[:3]), ("swelling",)), records[3:], rms


@pytest.mark.parametrize(("alpha", "noise", "seed"), [(0.02, 0.001, 1), (0.05, 0.003, 2), (0.01, 0.0005, 3)])
def test_a_thin_clean_loop_is_left_to_the_model(alpha, noise, seed):
    dataset, unseen, rms = thin_loops(alpha, noise, seed)
    found = diagnose(dataset, Question("bouc-wen", options=DiagnosisOptions(jobs=1)))
    assert found.effects == ()
    assert found.verdict == "no-effect-needed"
    assert accuracy(found.after.problem.system, unseen, found.after.values).rmse < 1.15 * rms


@pytest.mark.long
def test_a_linear_device_with_a_delay():
    likely = ("backlash", "bias", "input-lag", "output-lag", "rayleigh-hysteresis", "resonance", "transport-delay")
    found = diagnose(late_lines(), Question("bouc-wen", among=likely, options=DiagnosisOptions(jobs=1)))
    assert not found.memory.needed
    assert found.effects == ("transport-delay",)
    values = {name: estimate.value for name, estimate in found.model.parameters.items()}
    assert values["alpha"] < 0.01
    assert values["d"] == pytest.approx(GAIN, rel=0.01)
    assert values["transport-delay.delay"] == pytest.approx(DELAY, rel=0.03)

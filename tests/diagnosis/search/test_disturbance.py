"""Noise without a hum that was found."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.evidence.noise import noise
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.search.disturbance import undisturbed
from hysteresis_bench.signals import Record

HUM = {"cosine": 0.3, "sine": -0.2, "frequency": 47.0}
TRUE = {"alpha": 0.3, "beta": 0.6, "gamma": 0.2, "d": 1.0}
TIMES = [np.linspace(0.0, 2.0, 400), np.sort(np.random.default_rng(3).uniform(5.0, 7.0, 300))]


def records_with(hum, level=0.0):
    """level : of white noise"""
    rng = np.random.default_rng(4)
    phases = [2 * np.pi * hum["frequency"] * time for time in TIMES]
    return tuple(
        Record(
            time,
            4.0 * np.sin(2 * np.pi * time),
            4.1 * np.sin(2 * np.pi * time)
            + hum["cosine"] * np.cos(phase)
            + hum["sine"] * np.sin(phase)
            + level * rng.standard_normal(time.size),
            f"record {number}",
        )
        for number, (time, phase) in enumerate(zip(TIMES, phases, strict=True))
    )


def hypothesis(*names):
    values = {**TRUE, **{f"periodic-disturbance.{key}": value for key, value in HUM.items()}}
    return Hypothesis(frozenset(names), values, np.zeros(700), np.zeros(700), ())


def fitter(records):
    return Fitter(Stack(registry.build("models", "bouc-wen"), records))


def test_the_hum_and_nothing_else_is_taken_off():
    loud, quiet = (records_with(hum, 0.01) for hum in (HUM, {**HUM, "cosine": 0.0, "sine": 0.0}))
    for found, expected in zip(
        undisturbed(fitter(loud), hypothesis("periodic-disturbance", "record-offset")), quiet, strict=True
    ):
        assert np.allclose(found.output, expected.output, rtol=0, atol=1e-12)
        assert noise(found).rms == pytest.approx(noise(expected).rms, rel=1e-6)


def test_without_a_hum_the_records_stay():
    records = records_with(HUM)
    assert undisturbed(fitter(records), hypothesis("drift")) is records

"""Noise from the data alone: against noise that was put in, on smooth, kinked, coarse, quantised, coloured data."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.diagnosis.evidence.noise import (
    MISSED,
    clipped_rms,
    fast_noise,
    noise,
    period,
    pooled_noise,
    unresolved,
)
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.kernels.value_grid import grid_step
from hysteresis_bench.signals import Record

TIME = np.arange(4000) / 1000.0
INPUTS = {
    "sine, 200 samples a period": 5.0 * np.sin(2 * np.pi * 5 * TIME),
    "sweep": 5.0 * np.sin(2 * np.pi * (1 + TIME) * TIME),
    "triangle": np.abs((5 * TIME) % 1 - 0.5) * 20 - 5,
    "steps": np.repeat(np.random.default_rng(1).uniform(-5, 5, 40), 100),
}


def loop(u: Array) -> Array:
    """A hysteretic output: slope changes abruptly at every reversal."""
    h = np.zeros(u.size)
    for i in range(1, u.size):
        step = u[i] - u[i - 1]
        h[i] = h[i - 1] + step - 0.6 * abs(step) * h[i - 1] - 0.3 * step * abs(h[i - 1])
    return 2.0 * u - h


def autoregressive(rho: float, samples: int, rng: np.random.Generator) -> Array:
    e = np.zeros(samples)
    for i, shock in enumerate(rng.standard_normal(samples)):
        e[i] = rho * e[i - 1] + np.sqrt(1 - rho**2) * shock if i else shock
    return e


@pytest.mark.parametrize("level", [0.002, 0.01])
@pytest.mark.parametrize("shape", INPUTS)
def test_finds_the_noise_that_was_put_in(shape: str, level: float) -> None:
    u = INPUTS[shape]
    clean = loop(u)
    true = level * np.ptp(clean)
    rng = np.random.default_rng(7)
    found = [noise(Record(TIME, u, clean + true * rng.standard_normal(u.size))) for _ in range(10)]
    ratios = np.array([one.rms for one in found]) / true
    assert abs(ratios.mean() - 1) < 0.03
    assert np.all(np.abs(ratios - 1) < 0.08)
    errors = np.array([one.standard_error for one in found]) / true
    assert 0.4 < ratios.std() / errors.mean() < 2.0


@pytest.mark.parametrize("shape", INPUTS)
def test_without_noise_there_is_none(shape: str) -> None:
    clean = loop(INPUTS[shape])
    assert noise(Record(TIME, INPUTS[shape], clean)).rms < 1e-9 * np.ptp(clean)


def test_coarse_loop_of_uneven_samples() -> None:
    rng = np.random.default_rng(3)
    phase = np.cumsum(rng.uniform(0.6, 1.4, 257))
    u = np.cos(2 * np.pi * phase / phase[-1])
    clean = loop(5 * u)
    found = [fast_noise(phase, clean + 0.02 * rng.standard_normal(u.size))[0] for _ in range(20)]
    assert np.mean(found) == pytest.approx(0.02, rel=0.08)


def test_rounding_is_noise() -> None:
    clean = loop(INPUTS["sweep"])
    step = 0.05
    rounded = np.rint(clean / step) * step
    found = noise(Record(TIME, INPUTS["sweep"], rounded))
    assert grid_step(rounded) == pytest.approx(step)
    assert found.rms == pytest.approx(np.std(rounded - clean), rel=0.15)
    resting = np.concatenate([np.full(300, 3 * step), np.full(300, 4 * step), np.full(300, 2 * step)])
    assert noise(Record(np.arange(900.0), resting, resting)).rms == pytest.approx(step / np.sqrt(12))


def test_coloured_noise_is_told_by_the_repeats() -> None:
    rng = np.random.default_rng(5)
    u = INPUTS["sine, 200 samples a period"]
    white = noise(Record(TIME, u, loop(u) + 0.1 * rng.standard_normal(u.size)))
    assert not white.coloured
    assert white.repeat_rms == pytest.approx(0.1, rel=0.05)
    red = noise(Record(TIME, u, loop(u) + 0.1 * autoregressive(0.9, u.size, rng)))
    assert red.coloured
    assert "coloured" in red.words
    assert red.repeat_rms == pytest.approx(0.1, rel=0.15)
    assert red.rms < 0.5 * 0.1
    assert red.by_lag[0] < red.by_lag[1] < red.by_lag[2]


def test_noise_of_the_input_reaches_the_output_through_the_slope() -> None:
    rng = np.random.default_rng(6)
    u = INPUTS["sine, 200 samples a period"]
    found = noise(Record(TIME, u + 0.02 * rng.standard_normal(u.size), 3.0 * u))
    assert found.input_rms == pytest.approx(0.02, rel=0.05)
    assert found.through_input == pytest.approx(0.06, rel=0.1)
    assert found.floor == pytest.approx(0.06, rel=0.1)


def test_a_command_of_many_cycles_has_no_noise_of_its_own() -> None:
    time = np.arange(6000) * 2e-4
    u = 2.5 * np.sin(2 * np.pi * 50.0 * time)  # samples lie evenly about every turning point: no slope is clear there
    y = np.sin(2 * np.pi * 50.0 * time - 0.7) + 0.003 * np.random.default_rng(5).standard_normal(time.size)
    found = noise(Record(time, u, y))
    assert found.input_rms == found.through_input == 0.0
    assert found.floor == pytest.approx(0.003, rel=0.05)


def test_repeats_need_a_period_that_comes_back() -> None:
    assert period(INPUTS["sine, 200 samples a period"]) == 200
    assert period(INPUTS["sweep"]) is None
    assert period(INPUTS["sine, 200 samples a period"][:500]) is None
    assert period(np.ones(500)) is None


def test_pooled_noise_weighs_by_samples() -> None:
    rng = np.random.default_rng(8)
    u = INPUTS["sweep"]
    quiet = Record(TIME, u, loop(u) + 0.01 * rng.standard_normal(u.size))
    loud = Record(TIME[:2000], u[:2000], (loop(u) + 0.03 * rng.standard_normal(u.size))[:2000])
    both = pooled_noise([noise(quiet), noise(loud)])
    assert both.rms == pytest.approx(np.sqrt((2 * 0.01**2 + 0.03**2) / 3), rel=0.05)
    assert both.samples == 6000
    assert both.repeat_rms is None


@pytest.mark.parametrize("samples", [20, 60, 400])
@pytest.mark.parametrize("cycles", [3, 10])
def test_what_samples_miss_of_a_sine(samples: int, cycles: int) -> None:
    """Second differences are 4 sin^2(pi / samples) of the sine, whose median size is 1 / sqrt 2 of its height; an
    arc sags by an eighth of them."""
    time = np.arange(samples * cycles + 1) / samples
    u = 3.0 + 5.0 * np.sin(2 * np.pi * time + 0.1)
    sag = 5.0 * np.sin(np.pi / samples) ** 2 / 2.0 / np.sqrt(2.0)
    record = Record(time, u, -2.0 * u)
    assert unresolved([record]) == pytest.approx(MISSED * 2.0 * sag, rel=0.1)
    between = time[1:] - 0.5 / samples
    missed = np.abs(np.interp(between, time, u) - 3.0 - 5.0 * np.sin(2 * np.pi * between + 0.1))
    assert np.median(missed) == pytest.approx(sag, rel=0.1)
    assert unresolved([record, record]) == pytest.approx(unresolved([record]))


def test_samples_miss_nothing_of_straight_lines() -> None:
    u = INPUTS["triangle"]
    assert unresolved([Record(TIME, u, loop(u))]) < 1e-12
    assert unresolved([Record(TIME[:2], u[:2], u[:2])]) == 0.0
    assert unresolved([Record(TIME, np.ones(TIME.size), u)]) == 0.0


def test_clipping_forgets_outliers() -> None:
    rng = np.random.default_rng(9)
    values = rng.standard_normal(5000)
    assert clipped_rms(values)[0] == pytest.approx(1.0, abs=0.03)
    values[:400] = 50.0
    assert clipped_rms(values)[0] == pytest.approx(1.0, abs=0.04)


def test_a_constant_and_a_handful_of_samples_have_no_noise() -> None:
    assert noise(Record(TIME, TIME, np.full(TIME.size, 3.0))).rms == 0.0
    assert noise(Record(TIME[:5], TIME[:5], np.array([0.0, 1.0, 0.5, 2.0, 3.1]))).standard_error == 0.0


def test_piezo_sensor(real_data: Path) -> None:
    """The sensor's noise was measured at rest: 0.065 um."""
    for file in ("full_amplitude_1Hz.csv", "modulated_1Hz_ramp_down.csv"):
        record = read_data([real_data / "piezo-picma-ntu" / file]).records[0]
        assert noise(record).rms == pytest.approx(0.065, rel=0.2)


@pytest.mark.parametrize("quantum", [0.0, 0.02])
@pytest.mark.parametrize("seed", range(4))
def test_a_converter_at_its_end_is_silent_there_and_nowhere_else(seed, quantum):
    """More than half of the samples are at an end: the median difference is 0 there, and the noise was told as 0."""
    true = 8.0 * np.sin(2 * np.pi * 5 * TIME)
    noisy = true + 0.05 * np.random.default_rng(seed).normal(size=TIME.size)
    y = np.clip(np.rint(noisy / quantum) * quantum if quantum else noisy, -4.0, 4.0)
    clipped = np.mean(np.abs(y) == 4.0)
    assert clipped > 0.6
    record = Record(TIME, INPUTS["sweep"], y)
    expected = 0.05 * np.sqrt(1.0 - clipped)
    assert noise(record).rms == pytest.approx(expected, rel=0.15)
    left = y - np.clip(true, -4.0, 4.0)
    assert View.of(record).heard_in(left).noise.rms == pytest.approx(expected, rel=0.15)


def test_a_coarse_output_that_rests_at_its_peaks_is_not_at_an_end():
    """Equal values are as usual between the peaks as at them."""
    y = np.rint(loop(INPUTS["sweep"][:800]))
    whole = noise(Record(TIME[:800], INPUTS["sweep"][:800], y))
    assert whole.rms == pytest.approx(1.0 / np.sqrt(12.0), rel=0.01)

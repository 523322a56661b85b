"""Dynamics, changes and disturbances, each against its own formula."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.signals import Record, Signal
from tests.plugins.around import DRIVE, SINCE, STEP, TIME, applied, box, record


@pytest.mark.parametrize("name", ["input-lag", "output-lag"])
def test_a_lag_answers_a_step_exponentially(name):
    y = applied(name, STEP, time_constant=0.5)
    start = y[1] - 2.0
    np.testing.assert_allclose(y[1:], 2.0 + start * np.exp(-SINCE[1:] / 0.5), atol=1e-12)
    assert abs(start + 2.0) < 0.03  # the step's own edge takes one sample


def test_a_lag_before_and_after_a_linear_model_are_the_same():
    signal = record().signal
    before, after = (applied(name, signal, time_constant=0.3) for name in ("input-lag", "output-lag"))
    np.testing.assert_allclose(before, after, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "first"), [("second-order-lag", "output-lag"), ("second-order-input-lag", "input-lag")]
)
def test_a_second_order_lag_is_two_lags_in_series(name, first):
    """Of a step, against the closed form of two lags; each of them once, against a lag of the other's answer."""
    slow, fast = 0.4, 0.1
    damping = 0.5 * (slow + fast) / np.sqrt(slow * fast)
    y = applied(name, STEP, time_constant=slow + fast, damping=damping)
    left = (slow * np.exp(-SINCE[1:] / slow) - fast * np.exp(-SINCE[1:] / fast)) / (slow - fast)
    np.testing.assert_allclose(y[1:], 2.0 * (1.0 - left), atol=0.03)  # the step's own edge takes one sample
    fine = np.linspace(2.0, 6.0, 40001)
    signal = record(fine, 3.0 * np.sin(2 * np.pi * fine) + 0.5).signal
    lagged = applied("output-lag", signal, time_constant=slow)
    twice = applied(first, signal.with_input(0.5 * lagged[:, None]), time_constant=fast)
    np.testing.assert_allclose(applied(name, signal, time_constant=slow + fast, damping=damping), twice, atol=1e-7)


def test_a_damped_stage_is_a_resonance_up_to_where_it_has_a_peak_and_a_second_order_lag_beyond():
    slower = record(drive=3.0 * np.sin(np.pi * TIME))
    assert box("resonance", record(), slower)["damping"][1] == box("second-order-lag", record(), slower)["damping"][0]
    values = {"damping": np.sqrt(0.5), "time_constant": 0.2}
    period = np.pi * values["time_constant"] / values["damping"]
    resonating = applied("resonance", record().signal, period=period, damping=values["damping"])
    np.testing.assert_allclose(applied("second-order-lag", record().signal, **values), resonating, atol=1e-12)
    frequency = np.geomspace(0.01, 10.0, 400)
    gains = {z: 1.0 / np.hypot(1.0 - frequency**2, 2.0 * z * frequency) for z in (0.65, 0.72)}
    assert gains[0.65].max() > 1.01
    assert gains[0.72].max() <= 1.0


def test_a_delayed_output_is_the_output_of_an_earlier_input():
    y = applied("transport-delay", record().signal, delay=0.137)
    np.testing.assert_allclose(y, 2.0 * np.interp(TIME - 0.137, TIME, DRIVE), atol=1e-12)


def test_behind_a_late_input_the_output_is_that_of_a_later_one():
    y = applied("late-input", record().signal, advance=0.137)
    np.testing.assert_allclose(y, 2.0 * np.interp(TIME + 0.137, TIME, DRIVE), atol=1e-12)
    uneven = np.sort(np.random.default_rng(1).uniform(0.0, 5.0, 90))
    drive = np.sin(3.0 * uneven)
    y = applied("late-input", Signal(uneven, drive[:, None]), advance=0.2)
    np.testing.assert_allclose(y, 2.0 * np.interp(uneven + 0.2, uneven, drive), atol=1e-12)


@pytest.mark.parametrize("rate", [0.013, -0.02])
def test_a_clock_that_runs_slow_shows_what_comes_later(rate):
    y = applied("clock-error", record().signal, rate=rate)
    np.testing.assert_allclose(y, 2.0 * np.interp(TIME + rate * (TIME - TIME[0]), TIME, DRIVE), atol=1e-12)
    uneven = 3.0 + np.sort(np.random.default_rng(1).uniform(0.0, 5.0, 90))
    drive = np.sin(3.0 * uneven)
    y = applied("clock-error", Signal(uneven, drive[:, None]), rate=rate)
    np.testing.assert_allclose(y, 2.0 * np.interp(uneven + rate * (uneven - uneven[0]), uneven, drive), atol=1e-12)


def test_creep_keeps_the_static_gain_and_grows_with_the_logarithm_of_time():
    time = np.concatenate([[-1e-6], np.geomspace(1e-6, 1e5, 2000)])
    step = Signal(time, np.where(time > 0, 1.0, 0.0)[:, None])
    y = applied("creep", step, share=0.3, time_constant=1.0, decades=4.0)
    np.testing.assert_allclose(y[[0, 1, -1]], [0.0, 1.4, 2.0], atol=1e-4)
    decades = np.log10(time[1:])
    between = (decades > -1.5) & (decades < 1.5)
    line = np.polynomial.Polynomial.fit(decades[between], y[1:][between], 1)
    ripple = y[1:][between] - line(decades[between])
    assert np.max(np.abs(ripple)) < 0.03 * 0.6
    np.testing.assert_allclose(line.convert().coef[1], 0.6 / 5, rtol=0.1)  # five relaxations, one a decade


def test_creep_of_no_decades_is_one_relaxation():
    signal = record().signal
    y = applied("creep", signal, share=0.4, time_constant=0.7, decades=0.0)
    expected = 0.6 * 2.0 * DRIVE + 0.4 * applied("output-lag", signal, time_constant=0.7)
    np.testing.assert_allclose(y, expected, atol=1e-12)


def test_droop_lets_a_step_decay_and_keeps_what_was_there_at_the_first_sample():
    time = np.concatenate([[-1e-9], np.linspace(1e-9, 8.0, 500)])
    step = Signal(time, np.where(time > 0, 1.5, 0.5)[:, None])
    y = applied("droop", step, rate=0.7, share=1.0)
    np.testing.assert_allclose(y, 1.0 + np.where(time > 0, 2.0 * np.exp(-0.7 * np.maximum(time, 0.0)), 0.0), atol=1e-8)


def test_droop_is_a_high_pass():
    from scipy.signal import lsim

    rate, signal = 0.8, record().signal
    _, passed, _ = lsim(([1.0, 0.0], [1.0, rate]), 2.0 * (DRIVE - DRIVE[0]), TIME - TIME[0])
    whole = applied("droop", signal, rate=rate, share=1.0)
    np.testing.assert_allclose(whole, 2.0 * DRIVE[0] + passed, atol=1e-10)
    np.testing.assert_allclose(
        applied("droop", signal, rate=rate, share=0.3), 0.3 * whole + 0.7 * 2.0 * DRIVE, atol=1e-12
    )


def test_drift_counts_from_the_first_sample():
    np.testing.assert_allclose(applied("drift", record().signal, rate=-0.25), 2.0 * DRIVE - 0.25 * (TIME - 2.0))


def test_a_bias_reaches_as_far_as_a_response_to_an_input_far_from_zero():
    """A displacement of 0 to 2, zeroed at a bias of 100 V."""
    drive = 100.0 + np.sin(2 * np.pi * TIME)
    low, high = box("bias", record(drive=drive, output=drive - 99.0))["offset"]
    assert low < -99.0
    low, high = box("bias", record(drive=drive - 100.0, output=drive - 99.0))["offset"]
    assert (low, high) == pytest.approx((-2.0, 4.0), abs=1e-3)


def test_fatigue_falls_with_the_path_and_not_with_time():
    drive = np.array([0.0, 1.0, 1.0, -1.0, 1.0])
    y = applied("fatigue", Signal(np.arange(5.0), drive[:, None]), rate=0.1)
    np.testing.assert_allclose(y, 2.0 * drive * np.exp(-0.1 * np.array([0, 1, 1, 3, 5])))


def test_a_disturbance_keeps_its_phase_in_a_part_of_a_record():
    whole = record()
    values = {"cosine": 0.3, "sine": -0.2, "frequency": 7.3}
    full = applied("periodic-disturbance", whole.signal, **values)
    part = applied("periodic-disturbance", whole.take(slice(100, None)).signal, **values)
    np.testing.assert_allclose(part, full[100:], rtol=0, atol=1e-12)
    amplitude, phase = np.hypot(0.3, 0.2), np.arctan2(-0.2, 0.3)
    np.testing.assert_allclose(full - 2 * DRIVE, amplitude * np.cos(2 * np.pi * 7.3 * TIME - phase), atol=1e-12)


@pytest.mark.parametrize("uneven", [False, True])
def test_a_hum_is_found_beside_noise_a_trend_and_harmonics_of_the_drive(uneven):
    rng = np.random.default_rng(1)
    records, residuals = [], []
    for name, samples in (("a", 1500), ("b", 2100)):
        time = np.linspace(0.0, samples / 500, samples)
        time = time + (rng.uniform(-4e-4, 4e-4, samples) if uneven else 0.0)
        drive = np.sin(2 * np.pi * 2.0 * time)
        hum = 0.05 * np.sin(2 * np.pi * 49.9 * time + 0.4)
        misfit = 0.4 * drive**3 + 0.3 * np.cos(2 * np.pi * 8.0 * time) + 0.2 * time
        records.append(Record(time, drive, drive, name=name))
        residuals.append(hum + misfit + 0.1 * rng.normal(size=samples))
    first, *_ = registry.build("effects", "periodic-disturbance").starts(records, residuals)
    assert abs(first["frequency"] - 49.9) < 0.1
    assert abs(np.hypot(first["cosine"], first["sine"]) - 0.05) < 0.02
    for key, (low, high) in box("periodic-disturbance", *records).items():
        assert low <= first[key] <= high


def test_temperature_scales_and_shifts():
    warm = np.linspace(20.0, 60.0, TIME.size)
    signal = replace(record().signal, columns={"temperature": warm})
    y = applied("temperature-sensitivity", signal, gain=0.01, expansion=-0.02)
    np.testing.assert_allclose(y, 2.0 * DRIVE * (1 + 0.01 * (warm - 20)) - 0.02 * (warm - 20))
    kelvin = replace(signal, columns={"temperature": warm + 273.15})
    again = applied("temperature-sensitivity", kelvin, {"reference": 293.15}, gain=0.01, expansion=-0.02)
    np.testing.assert_allclose(again, y, rtol=1e-12)


def test_a_device_warms_up_behind_the_measured_temperature():
    """A step of temperature, as a ramp of one sample: the device comes to it exponentially."""
    steps = np.where(TIME[10] < TIME, 30.0, 20.0)
    signal = replace(record().signal, columns={"temperature": steps})
    y = applied("thermal-inertia", signal, gain=0.01, expansion=-0.02, time_constant=0.4)
    h = TIME[11] - TIME[10]
    after = 10.0 * (1.0 - (1.0 - np.exp(-h / 0.4)) / (h / 0.4) * np.exp(-(TIME[11:] - TIME[11]) / 0.4))
    np.testing.assert_allclose(y[:11], 2.0 * DRIVE[:11])
    np.testing.assert_allclose(y[11:], 2.0 * DRIVE[11:] * (1 + 0.01 * after) - 0.02 * after, rtol=1e-9)
    at_once = applied("temperature-sensitivity", signal, gain=0.01, expansion=-0.02)
    without = applied("thermal-inertia", signal, gain=0.01, expansion=-0.02, time_constant=0.0)
    np.testing.assert_allclose(without, at_once, rtol=1e-14)


def test_record_drift_takes_a_line_from_every_record_and_leaves_its_mean():
    effect = registry.build("effects", "record-drift")
    slow = record(output=2.0 * DRIVE + 0.3 + 0.7 * (TIME - 2.0))
    adjusted = effect.adjust((2.0 * DRIVE)[:, None], slow)[:, 0]
    np.testing.assert_allclose(adjusted - 2.0 * DRIVE, 0.7 * (TIME - TIME.mean()), atol=1e-12)
    part = replace(slow, history=200)  # only what is scored counts
    np.testing.assert_allclose(
        effect.adjust((2.0 * DRIVE)[:, None], part)[:, 0] - 2.0 * DRIVE, 0.7 * (TIME - 5.0), atol=1e-12
    )
    assert np.array_equal(effect.adjust((2.0 * DRIVE)[:, None], replace(slow, output=None))[:, 0], 2.0 * DRIVE)

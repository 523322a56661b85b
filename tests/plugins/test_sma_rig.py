"""The shape memory alloy rig against closed forms, conservation of energy, and what it says of itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import cumulative_simpson
from scipy.linalg import expm

from hysteresis_plugins.rigs.sma import SUPPLY, SmaRig

PULSE = (np.arange(0.0, 80.0, 0.1), np.where(np.arange(800) < 400, SUPPLY, 0.0))
RAMP = np.arange(0.0, 3600.0, 1.0)
TRIANGLE = (RAMP, SUPPLY * np.sqrt(1.0 - np.abs(RAMP / 1800.0 - 1.0)))


def wire_heat_capacity(rig: SmaRig) -> float:
    return rig.density * np.pi / 4.0 * rig.wire_diameter**2 * rig.specific_heat


def power(rig: SmaRig, voltage: np.ndarray) -> np.ndarray:
    """W/m"""
    return voltage**2 / (rig.resistance * rig.wire_length)


def test_one_body_heats_and_cools_exponentially() -> None:
    rig = SmaRig(wire_lag=0.0, latent_heat=0.0, ambient=-1.0)
    time, voltage = PULSE
    tau = (rig.jacket_heat_capacity + wire_heat_capacity(rig)) / rig.convection
    final = power(rig, np.array(SUPPLY)) / rig.convection
    heating = final * -np.expm1(-time / tau)
    cooling = final * -np.expm1(-40.0 / tau) * np.exp(-(time - 40.0) / tau)
    expected = rig.ambient + np.where(time <= 40.0, heating, cooling)
    assert_allclose(rig.simulate(time, voltage).wire, expected, atol=1e-5)


def test_jacket_wire_and_sensor_follow_the_matrix_exponential() -> None:
    rig = SmaRig(latent_heat=0.0, sensor_lag=0.7)
    time, voltage = PULSE
    exchange = wire_heat_capacity(rig) / rig.wire_lag
    system = np.array(
        [
            [-(rig.convection + exchange) / rig.jacket_heat_capacity, exchange / rig.jacket_heat_capacity, 0.0],
            [1.0 / rig.wire_lag, -1.0 / rig.wire_lag, 0.0],
            [1.0 / rig.sensor_lag, 0.0, -1.0 / rig.sensor_lag],
        ]
    )
    decay = expm(0.1 * system)
    state, expected = np.zeros(3), []
    for volts in voltage:
        expected.append(state)
        rest = -np.linalg.solve(system, [power(rig, volts) / rig.jacket_heat_capacity, 0.0, 0.0])
        state = rest + decay @ (state - rest)
    truth = rig.simulate(time, voltage)
    assert_allclose(np.stack([truth.jacket, truth.wire, truth.reading], axis=1), expected, atol=1e-5)


@pytest.mark.parametrize("wire_lag", [0.0, 3.4])
def test_energy_is_conserved_with_latent_heat(wire_lag: float) -> None:
    rig = SmaRig(wire_lag=wire_lag)
    time = np.arange(0.0, 80.0, 0.01)
    voltage = np.where(time < 40.0, SUPPLY, 0.0)
    truth = rig.simulate(time, voltage)
    assert truth.martensite.min() < 0.01
    lost = cumulative_simpson(rig.convection * (truth.jacket - rig.ambient), x=time, initial=0.0)
    supplied = np.concatenate([[0.0], np.cumsum(power(rig, voltage[:-1]) * np.diff(time))])
    stored = rig.jacket_heat_capacity * (truth.jacket - rig.ambient)
    stored += wire_heat_capacity(rig) * (truth.wire - rig.ambient)
    stored += wire_heat_capacity(rig) / rig.specific_heat * rig.latent_heat * (1.0 - truth.martensite)
    assert_allclose(stored, supplied - lost, atol=1e-4 * supplied[-1])


def test_mechanics_balances_forces_and_lengths() -> None:
    rig = SmaRig()
    truth = rig.simulate(*PULSE)
    section, length = np.pi / 4.0 * rig.wire_diameter**2, rig.wire_length
    rotation = np.radians(truth.angle)
    passive = truth.stress - rig.torsion_stiffness * rotation / (rig.coupler_radius * section)
    modulus = rig.austenite_modulus + truth.martensite * (rig.martensite_modulus - rig.austenite_modulus)

    def end(stress: np.ndarray, modulus: np.ndarray, martensite: np.ndarray) -> np.ndarray:
        stretch = length * (stress / modulus + rig.transformation_strain * martensite)
        return stretch + section * stress / rig.anchor_stiffness

    driven_end = end(truth.stress, modulus, truth.martensite)
    passive_end = end(passive, np.full_like(passive, rig.martensite_modulus), np.ones_like(passive))
    assert_allclose(driven_end[0] - driven_end, rig.coupler_radius * rotation, atol=1e-12)
    assert_allclose(passive_end - passive_end[0], rig.coupler_radius * rotation, atol=1e-12)
    assert truth.angle[0] == pytest.approx(0.0, abs=1e-9)
    assert truth.stress[0] == pytest.approx(rig.prestress)


def test_heating_and_cooling_transform_at_their_own_temperatures() -> None:
    rig = SmaRig(ambient=-25.0, resistance=6.5)
    truth = rig.simulate(*TRIANGLE)
    top = int(np.argmax(truth.wire))
    hottest_stress = truth.stress.max()
    start = rig.austenite_start + rig.prestress / rig.austenite_slope
    finish = rig.austenite_finish + hottest_stress / rig.austenite_slope
    back = rig.martensite_start + hottest_stress / rig.martensite_slope
    end = rig.martensite_finish + rig.prestress / rig.martensite_slope
    heating, cooling = slice(0, top), slice(top, None)

    def ever(branch: slice, below: float, above: float) -> np.ndarray:
        wire = truth.wire[branch]
        return truth.martensite[branch][(wire > below) & (wire < above)]

    assert np.all(ever(heating, -np.inf, start) == 1.0)
    assert np.all(ever(heating, start + 0.5, finish) < 1.0)
    assert_allclose(ever(heating, finish + 0.1, np.inf), 0.0, atol=1e-9)
    assert_allclose(ever(cooling, back, np.inf), 0.0, atol=1e-9)
    assert np.all(ever(cooling, -np.inf, back - 0.5) > 0.0)
    assert_allclose(ever(cooling, -np.inf, end - 0.1), 1.0, atol=1e-9)


def test_whole_transformations_follow_the_cosine_law_at_their_own_stress() -> None:
    rig = SmaRig(ambient=-25.0, resistance=6.5)
    truth = rig.simulate(*TRIANGLE)
    top = int(np.argmax(truth.wire))

    def remaining(progress: np.ndarray) -> np.ndarray:
        return 0.5 * (1.0 + np.cos(np.pi * np.clip(progress, 0.0, 1.0)))

    onset = rig.austenite_start + truth.stress / rig.austenite_slope
    heated = remaining((truth.wire - onset) / (rig.austenite_finish - rig.austenite_start))
    return_onset = rig.martensite_start + truth.stress / rig.martensite_slope
    cooled = 1.0 - remaining((return_onset - truth.wire) / (rig.martensite_start - rig.martensite_finish))
    assert_allclose(truth.martensite[:top], heated[:top], atol=1e-9)
    assert_allclose(truth.martensite[top:], cooled[top:], atol=1e-9)


def test_quasi_static_loop_closes_with_positive_width() -> None:
    rig = SmaRig()
    record = (
        replace(rig, temperature_noise=0.0, angle_noise=0.0, angle_resolution=0.0)
        .measure("slow", np.random.default_rng(0))
        .records[0]
    )
    half = record.time.size // 4
    rising, falling = slice(2 * half, 3 * half), slice(3 * half, 4 * half)
    grid = np.linspace(5.0, 55.0, 101)
    up = np.interp(grid, record.input[rising], record.output[rising])
    down = np.interp(grid, record.input[falling][::-1], record.output[falling][::-1])
    saturated = up > record.output.max() - 0.01
    assert np.all(down[~saturated] > up[~saturated])
    assert 2.0 < np.max(down - up) < 12.0
    assert abs(record.output[2 * half] - record.output[-1]) < 0.05


def test_minor_loops_nest() -> None:
    quiet = replace(SmaRig(), temperature_noise=0.0, angle_noise=0.0, angle_resolution=0.0)
    record = quiet.measure("minor-loops", np.random.default_rng(0)).records[0]
    output = record.output
    turns = output[np.flatnonzero(np.diff(np.sign(np.diff(np.round(output, 6))))) + 1]
    minor = turns[(turns > 10.0) & (turns < output.max() - 0.5)]
    high, low = minor[1::2], minor[0::2]
    assert minor.size == 9
    assert np.all(np.diff(high) < 0)
    assert np.all(np.diff(low) > 0)


def test_step_halving_converges() -> None:
    time, voltage = PULSE
    finest = SmaRig(step=0.003125).simulate(time, voltage).angle
    errors = [np.max(np.abs(SmaRig(step=step).simulate(time, voltage).angle - finest)) for step in (0.1, 0.025)]
    assert errors[0] < 5e-3
    assert errors[1] < errors[0] / 10.0
    for experiment in SmaRig.experiments:
        quiet = SmaRig(temperature_noise=0.0, angle_noise=0.0, angle_resolution=0.0)
        coarse = quiet.measure(experiment, np.random.default_rng(0)).records[0]
        fine = replace(quiet, step=quiet.step / 2).measure(experiment, np.random.default_rng(0)).records[0]
        assert_allclose(coarse.output, fine.output, atol=1e-3)
        assert_allclose(coarse.input, fine.input, atol=1e-3)


def test_noise_has_the_stated_level() -> None:
    rig = SmaRig(angle_resolution=0.0)
    noisy = rig.measure("pwm-60s-long", np.random.default_rng(3)).records[0]
    truth = rig.simulate(noisy.time, noisy.columns["voltage"])
    assert np.std(noisy.input - truth.reading) == pytest.approx(rig.temperature_noise, rel=0.05)
    assert np.std(noisy.output - truth.angle) == pytest.approx(rig.angle_noise, rel=0.05)


def test_angle_has_the_stated_resolution() -> None:
    counts = SmaRig(angle_resolution=0.5).measure("pwm-50s", np.random.default_rng(0)).records[0].output / 0.5
    assert_array_equal(counts, np.round(counts))


@pytest.mark.parametrize(("experiment", "samples"), [("pwm-50s", 1000), ("pwm-60s", 1200), ("pwm-60s-long", 3600)])
def test_pwm_experiments_are_the_papers(experiment: str, samples: int) -> None:
    record = SmaRig().measure(experiment, np.random.default_rng(0)).records[0]
    assert record.time.size == samples
    assert_allclose(np.diff(record.time), 0.1)
    assert set(record.columns["voltage"]) == {0.0, SUPPLY}
    assert np.mean(record.columns["voltage"] > 0.0) == 0.5
    assert abs(record.input[0]) < 0.5
    assert 58.0 < record.input.max() < 63.0
    assert abs(record.output[0]) < 0.5
    assert 20.0 < record.output.max() < 40.0


@pytest.mark.parametrize("experiment", SmaRig.experiments)
def test_same_generator_same_data(experiment: str) -> None:
    first, again, other = (SmaRig().measure(experiment, np.random.default_rng(seed)) for seed in (7, 7, 8))
    assert first.names == (experiment,)
    assert set(first.units) == {"time", "input", "output", "voltage"}
    assert_array_equal(first.records[0].input, again.records[0].input)
    assert_array_equal(first.records[0].output, again.records[0].output)
    assert not np.array_equal(first.records[0].output, other.records[0].output)
    assert np.all(np.diff(first.records[0].time) > 0)


def test_hidden_tells_what_is_switched_on() -> None:
    rig = SmaRig()
    hidden = rig.measure("pwm-50s", np.random.default_rng(0)).hidden
    assert hidden["input-lag"] == {"time_constant": rig.wire_lag}
    assert hidden["sensor-lag"] == {"time_constant": rig.sensor_lag}
    assert hidden["latent-heat"]["temperature_rise"] == pytest.approx(28.9, abs=0.1)
    assert hidden["noise"] == {"input": rig.temperature_noise, "output": rig.angle_noise}
    bare = SmaRig(wire_lag=0.0, sensor_lag=0.0, latent_heat=0.0, temperature_noise=0.0, angle_noise=0.0)
    assert bare.hidden == {}


def test_without_lags_the_reading_is_the_acting_temperature() -> None:
    lagging, prompt = SmaRig().simulate(*PULSE), SmaRig(wire_lag=0.0, sensor_lag=0.0).simulate(*PULSE)
    assert_array_equal(prompt.reading, prompt.wire)
    assert np.max(lagging.reading - lagging.wire) > 5.0


def test_default_wire_lag_is_that_of_the_air_gap() -> None:
    rig = SmaRig()
    conductance = 2.0 * np.pi * 0.026 / np.log(2.0e-3 / rig.wire_diameter)
    assert rig.wire_lag == pytest.approx(wire_heat_capacity(rig) / conductance, rel=0.02)


def test_unknown_experiment_names_the_known_ones() -> None:
    with pytest.raises(ValueError, match=r'"pwm".*pwm-50s, pwm-60s, pwm-60s-long, minor-loops, slow, steps'):
        SmaRig().measure("pwm", np.random.default_rng(0))


def test_settings_that_make_no_rig_are_told_at_once() -> None:
    with pytest.raises(ValueError, match=r"wire_lag must not be negative.*step must be above 0"):
        SmaRig(wire_lag=-1.0, step=0.0)
    with pytest.raises(ValueError, match="martensite_start lies above austenite_finish at"):
        SmaRig(martensite_start=29.0)
    with pytest.raises(ValueError, match="ambient lies above austenite_start"):
        SmaRig(ambient=20.0)

"""The magnetostrictive rig: eddy currents against Bessel functions, mechanics, magnetics, what it writes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import jv

from hysteresis_plugins.rigs._gma_bench import MODULUS, PRINTED
from hysteresis_plugins.rigs._gma_rod import PERMEABILITY, Material, diffused, uniform
from hysteresis_plugins.rigs.gma import RADIUS, RESISTIVITY, SATURATION, GmaRig

SUSCEPTIBILITY = 9.0
LINEAR = Material(np.ones(1), np.ones(1), np.zeros(1), SUSCEPTIBILITY * 1e15, 1.0, 1e15)
QUIET = {"ripple": 0.0, "noise": 0.0}


def amplitudes(frequency, shells, per_period):
    """Complex amplitude of the field in every shell under 1 A/m at the surface of a linear rod, in steady state."""
    periods = 6
    time = np.arange(periods * per_period + 1) / (frequency * per_period)
    omega = 2 * np.pi * frequency
    field, _ = diffused(np.sin(omega * time), time[1], RADIUS, shells, RESISTIVITY, LINEAR)
    phasor = np.exp(-1j * omega * time[-per_period:])
    return 2j / per_period * np.sum(field[-per_period:] * phasor[:, None], axis=0)


def bessel(frequency, shells):
    radius = (np.arange(shells) + 0.5) / shells * RADIUS
    wave = np.sqrt(-2j * np.pi * frequency * PERMEABILITY * (1 + SUSCEPTIBILITY) / RESISTIVITY)
    return jv(0, wave * radius) / jv(0, wave * RADIUS)


@pytest.mark.parametrize("frequency", [200.0, 2000.0])
def test_eddy_currents_in_a_linear_rod_follow_bessel_functions(frequency):
    errors = []
    for shells, per_period in ((6, 500), (12, 2000), (24, 8000)):
        errors.append(np.max(np.abs(amplitudes(frequency, shells, per_period) - bessel(frequency, shells))))
    # shielding is strong at 2 kHz: the centre of the rod sees two thirds of the field
    assert frequency < 1000.0 or abs(bessel(frequency, 24)[0]) < 0.67
    assert errors[2] < 1e-3
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 3.0


def test_slow_fields_reach_the_whole_rod():
    time = np.linspace(0.0, 100.0, 500)
    surface = 40e3 + 36e3 * np.sin(2 * np.pi * time / 50.0)
    _, through = diffused(surface, time[1], RADIUS, 5, RESISTIVITY, GmaRig().material)
    _, alike = uniform(surface, GmaRig().material)
    # 50 s against a diffusion time below 1 ms
    np.testing.assert_allclose(through, np.broadcast_to(alike, through.shape), rtol=1e-4)


def test_magnetization_is_bounded_and_its_loops_dissipate():
    surface = 3e5 * np.sin(np.linspace(0.0, 4 * np.pi, 2001))
    _, magnetization = uniform(surface, GmaRig().material)
    assert np.max(np.abs(magnetization)) < SATURATION
    loop = slice(1000, None)
    assert np.trapezoid(surface[loop], magnetization[loop, 0]) > 0.0


def test_constant_current_gives_the_static_displacement():
    rig = GmaRig(**QUIET)
    time = np.linspace(0.0, 0.01, 50)
    moved = rig.displacement(time, np.full(50, 2.0))
    _, magnetization = uniform(np.array([PRINTED["turns"] * 2.0 + rig.bias_field]), GmaRig().material)
    force = PRINTED["area"] * MODULUS * rig.strain(magnetization[0] / SATURATION)
    np.testing.assert_allclose(moved, np.full(50, 1e6 * force[0] / PRINTED["stiffness"]), rtol=1e-9)


def test_strain_bends_off_the_quadratic_law_and_keeps_rising():
    relative = np.linspace(0.0, 1.0, 101)
    bent, quadratic = GmaRig().strain(relative), GmaRig(strain_saturation=False).strain(relative)
    np.testing.assert_allclose(quadratic, 1.5e-3 * relative**2)
    assert np.all(np.diff(bent) > 0.0)
    assert bent[-1] < 0.75 * quadratic[-1]


def test_without_bias_the_frequency_doubles():
    def spectrum(**settings):
        record = GmaRig(**QUIET, **settings).measure("sine-50hz", np.random.default_rng(0)).records[0]
        return np.abs(np.fft.rfft(record.output[-500:]))[1:5]

    free, biased = spectrum(bias_field=0.0), spectrum()
    assert free[0] < 1e-2 * free[1]
    assert biased[0] > 10 * biased[1]


def test_eddy_currents_open_the_loop_with_frequency():
    def opening(experiment, **settings):
        record = GmaRig(**QUIET, **settings).measure(experiment, np.random.default_rng(0)).records[0]
        return abs(np.trapezoid(record.output[-501:], record.input[-501:]))

    gains = [opening(e) / opening(e, eddy_currents=False) - 1 for e in ("sine-1hz", "sine-50hz", "sine-200hz")]
    assert 0 <= gains[0] < 0.01 < gains[1] < gains[2]


def test_same_generator_same_data_and_effects_can_be_switched_off():
    def measured(seed, **settings):
        return GmaRig(**settings).measure("sine-200hz", np.random.default_rng(seed)).records[0].output

    assert np.array_equal(measured(1), measured(1))
    assert not np.array_equal(measured(1), measured(2))
    assert np.array_equal(measured(1, **QUIET), measured(2, **QUIET))
    assert 0.04 < np.std(measured(1, ripple=0.0) - measured(1, **QUIET)) < 0.06


@pytest.mark.parametrize("experiment", GmaRig.experiments)
def test_every_experiment_is_a_complete_record(experiment):
    dataset = GmaRig().measure(experiment, np.random.default_rng(0))
    (record,) = dataset.records
    assert record.name == experiment
    assert record.units == {"time": "s", "input": "A", "output": "um", "bias_field": "A/m"}
    assert np.all(np.diff(record.time) > 0)
    assert np.all(np.isfinite(record.output))
    assert record.input[0] == 0.0
    assert abs(np.max(record.input) - 2.5) < 1e-3
    np.testing.assert_array_equal(record.columns["bias_field"], 40e3)
    assert dataset.hidden["eddy_currents"] is True


def test_refuses_what_it_cannot_do():
    with pytest.raises(ValueError, match="sine-3hz"):
        GmaRig().measure("sine-3hz", np.random.default_rng(0))
    with pytest.raises(ValueError, match="amplitude"):
        GmaRig(amplitude=0.0)

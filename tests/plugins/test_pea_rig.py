"""The piezoelectric rig: its physics stage by stage, its sensor, its stepwise plant."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import least_squares

from hysteresis_bench.compose import System
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Objective, Problem
from hysteresis_bench.parameters import Space
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.rigs.pea import PLAYS, PeaRig

OFF = {"saturation": 0.0, "asymmetry": 0.0, "creep": 0.0, "bandwidth": 0.0, "natural_frequency": 0.0}
SILENT = {"noise": 0.0, "resolution": 0.0}


def bare(**settings):
    """A noise-free rig with only these effects on."""
    return PeaRig(**(OFF | SILENT | {"hysteresis": 0.0} | settings))


def ceramic(**settings):
    return bare(hysteresis=0.45, **settings)


def through(points, samples=50):
    knots = np.concatenate([[0.0], points])
    return np.interp(np.linspace(0, knots.size - 1, samples * (knots.size - 1) + 1), np.arange(knots.size), knots)


def response(rig, voltage, interval=1e-3):
    return rig.simulate(np.arange(voltage.size) * interval, voltage)


def test_with_everything_off_it_is_a_gain():
    voltage = through([2.0, -3.0, 1.0])
    np.testing.assert_allclose(response(bare(), voltage), 1.046 * voltage, rtol=0, atol=1e-12)


def test_ceramic_is_the_play_population_of_its_settings():
    rig = ceramic()
    voltage = through([2.5, -1.0, 2.0, -2.5])
    radii = -rig.half_width * np.log1p(-(np.arange(PLAYS) + 0.5) / PLAYS)
    plays, expected = np.zeros(PLAYS), []
    for level in voltage:
        plays = np.maximum(level - radii, np.minimum(level + radii, plays))
        expected.append(rig.gain * ((1 - rig.hysteresis) * level + rig.hysteresis * plays.mean()))
    np.testing.assert_allclose(response(rig, voltage), expected, rtol=0, atol=1e-12)


def test_minor_loops_close_are_congruent_and_are_wiped_out():
    rig = ceramic()
    voltage = through([2.5, -1.0, 0.0, -1.0, 2.5])
    y = response(rig, voltage)
    assert y[200] == pytest.approx(y[100], abs=1e-12)  # the inner loop between -1 and 0 V closes
    assert y[250] == pytest.approx(y[50], abs=1e-12)  # and the outer one does not know of it
    elsewhere = response(rig, through([-2.5, 0.0, -1.0, 0.0, -1.0]))
    np.testing.assert_allclose(elsewhere[150:251] - elsewhere[150], y[100:201] - y[100], rtol=0, atol=1e-12)
    assert elsewhere[150] != pytest.approx(y[100], abs=0.1)  # the same loop at another height


def test_ceramic_alone_knows_no_time():
    voltage = through([2.5, -1.0, 2.0])
    np.testing.assert_allclose(
        response(ceramic(), voltage, 1e-3), response(ceramic(), voltage, 1.0), rtol=0, atol=1e-11
    )


def test_loops_dissipate():
    voltage = through(np.tile([2.5, -2.5], 4))
    y = response(ceramic(saturation=15.0, asymmetry=0.006), voltage)
    assert np.sum(0.5 * (voltage[-100:] + voltage[-101:-1]) * np.diff(y[-101:])) > 0.1


def test_saturation_and_asymmetry_bend_the_response():
    ends = np.array([2.5, -2.5])
    top, bottom = (response(bare(saturation=15.0), through([end]))[-1] for end in ends)
    straight = 1.046 * 2.5
    assert top == pytest.approx(straight / np.sqrt(1 + (straight / 15) ** 2))
    assert bottom == -top
    top, bottom = (response(bare(asymmetry=0.006), through([end]))[-1] for end in ends)
    assert top / -bottom == pytest.approx((1 + 0.006 * straight) / (1 - 0.006 * straight))


def test_creep_grows_by_its_share_in_every_decade():
    rig = bare(creep=0.015, step=0.05)
    time = np.concatenate([[0.0, 1e-3], np.geomspace(0.01, 1000, 3000)])
    y = rig.simulate(time, np.where(time > 0, 1.0, 0.0)) / 1.046
    decades = np.interp([0.3, 3.0, 30.0, 300.0], time, y)
    np.testing.assert_allclose(np.diff(decades), 0.015, rtol=0.04)  # a ladder of elements ripples


def test_stage_resonates_as_published():
    rig = bare(natural_frequency=80.5, damping_ratio=0.504)
    time = np.arange(20_000) * 5e-5
    for frequency in (10.0, 50.0, 80.5, 200.0):
        y = rig.simulate(time, np.sin(2 * np.pi * frequency * time))
        late = time > 0.2
        basis = np.exp(-2j * np.pi * frequency * time[late])
        got = 2j * np.mean(y[late] * basis) / 1.046
        ratio = frequency / 80.5
        assert got == pytest.approx(1 / (1 - ratio**2 + 2j * 0.504 * ratio), abs=2e-2 if frequency == 200.0 else 5e-3)


def test_amplifier_lags_by_its_time_constant():
    rig = bare(bandwidth=100.0)
    time = np.arange(2000) * 1e-4
    y = rig.simulate(time, 10 * time)
    assert y[-1] == pytest.approx(1.046 * 10 * (time[-1] - 1 / (2 * np.pi * 100)), rel=1e-9)


def test_halving_the_internal_step_changes_less_than_a_nanometre():
    coarse, fine = PeaRig(), PeaRig(step=5e-5)
    for experiment in ("sine-50-hz", "complex"):
        time, voltage = coarse.drive(experiment)
        assert np.abs(coarse.simulate(time, voltage) - fine.simulate(time, voltage)).max() < 1e-3


def test_sensor_rounds_to_its_resolution_and_adds_its_noise():
    rng = np.random.default_rng(0)
    readings = PeaRig().sensed(np.full(20_000, 1.0), rng)
    np.testing.assert_allclose(readings / 0.003, np.round(readings / 0.003), atol=1e-9)
    assert np.std(readings) == pytest.approx(np.hypot(0.003, 0.003 / np.sqrt(12)), rel=0.05)


def test_the_noise_floor_is_the_rms_of_what_the_sensor_adds():
    rig, truth = PeaRig(), np.linspace(0.0, 1.0, 20_000)
    added = rig.sensed(truth, np.random.default_rng(0)) - truth
    assert rig.noise_floor == pytest.approx(np.sqrt(np.mean(added**2)), rel=0.02)


@pytest.mark.parametrize("experiment", PeaRig.experiments)
def test_every_experiment_gives_a_record_with_units_and_what_was_hidden(experiment):
    rig = PeaRig()
    data = rig.measure(experiment, np.random.default_rng(1))
    (record,) = data.records
    assert record.name == experiment
    assert record.units == {"time": "s", "input": "V", "output": "um"}
    assert record.time.size == (20_000 if experiment == "sweep" else 6000)
    assert np.all(np.diff(record.time) > 0)
    assert record.input[0] == 0.0
    assert np.abs(record.input).max() <= rig.voltage_limit
    assert np.isfinite(record.output).all()
    assert set(data.hidden) == {"input-lag", "saturation", "asymmetry", "creep", "resonance", "noise"}
    again = rig.measure(experiment, np.random.default_rng(1)).records[0].output
    np.testing.assert_array_equal(record.output, again)


def test_what_is_switched_off_is_not_hidden():
    assert PeaRig(**(OFF | SILENT)).hidden == {}


def test_plant_stepped_along_a_drive_is_the_simulation():
    rig = PeaRig()
    time, voltage = rig.drive("sine-20-hz")
    plant = rig.plant(1 / (time[1] - time[0]))
    state, displacement = plant.rest(), []
    for first, last in pairwise(voltage[:501]):
        displacement.append(plant.displacement(state))
        state = plant.ramp(state, first, last)
    np.testing.assert_allclose(displacement, rig.simulate(time, voltage)[:500], rtol=0, atol=1e-9)


def test_plant_leaves_the_state_it_is_given_alone_and_cuts_the_voltage():
    plant = PeaRig().plant(5000)
    state = plant.step(plant.rest(), 1.0)
    kept = state.copy()
    beyond, limit = plant.step(state, 100.0), plant.step(state, 5.0)
    np.testing.assert_array_equal(state, kept)
    np.testing.assert_array_equal(beyond, limit)
    assert plant.displacement(limit) != plant.displacement(state)


def test_an_integrating_controller_removes_the_hysteresis_of_the_plant():
    plant, rng = PeaRig().plant(5000), np.random.default_rng(2)
    time = np.arange(5000) / 5000
    target = 2.0 * np.sin(2 * np.pi * time)
    errors = {}
    for gain in (0.0, 150.0):
        state, integral, reached = plant.rest(), 0.0, []
        for aim in target:
            integral += gain / 5000 * (aim - plant.read(state, rng))
            state = plant.step(state, aim / 1.046 + integral)
            reached.append(plant.displacement(state))
        errors[gain] = np.std(np.array(reached) - target)
    assert errors[150.0] < 0.3 * errors[0.0]


def test_bouc_wen_fits_it_about_as_well_as_the_published_device():
    data = PeaRig().measure("static-sine", np.random.default_rng(3)).records
    meter = Objective(Problem(System(BoucWen()), data, Space(BoucWen.parameters), LOSSES["rmse"]), 300)
    least_squares(meter.residuals, np.full(4, 0.1), bounds=(0, 1), max_nfev=40)
    assert 0.01 < meter.best < 0.05  # um; PEA paper, Table 2: 0.029
    alpha, beta, gamma, d = meter.trace.points[-1]
    assert alpha == pytest.approx(0.304225, rel=0.2)
    assert beta + gamma == pytest.approx(0.675313 + 0.497724, rel=0.4)
    assert d == pytest.approx(1.045814, rel=0.05)


def test_bad_settings_and_experiments_are_refused_in_one_go():
    with pytest.raises(ValueError, match=r"gain .* · .*noise"):
        PeaRig(gain=0.0, noise=-1.0)
    with pytest.raises(ValueError, match="at most 1"):
        PeaRig(hysteresis=1.5)
    with pytest.raises(ValueError, match="static-sine"):
        PeaRig().measure("sine", np.random.default_rng(0))

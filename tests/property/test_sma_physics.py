"""What the physics of the shape memory alloy rig promises under any voltage."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from hysteresis_plugins.rigs.sma import SUPPLY, SmaRig

RIGS = (
    SmaRig(),
    SmaRig(wire_lag=0.0, sensor_lag=0.0),
    SmaRig(latent_heat=0.0),
    SmaRig(martensite_finish=9.0, martensite_start=18.4, austenite_start=34.5, austenite_finish=49.0, ambient=5.0),
)

rigs = st.sampled_from(RIGS)
voltages = st.lists(st.tuples(st.floats(0.0, 1.2 * SUPPLY), st.integers(1, 200)), min_size=1, max_size=12).map(
    lambda parts: np.concatenate([np.full(count, level) for level, count in parts])
)


def remaining(progress: np.ndarray) -> np.ndarray:
    return np.cos(np.pi / 2.0 * np.clip(progress, 0.0, 1.0)) ** 2


@settings(max_examples=60, deadline=None)
@given(rigs, voltages)
def test_martensite_is_a_fraction_continuous_and_inside_the_major_loop(rig: SmaRig, voltage: np.ndarray) -> None:
    truth = rig.simulate(np.arange(voltage.size) * 0.1, voltage)
    assert np.all((truth.martensite >= 0.0) & (truth.martensite <= 1.0))

    heating_band = rig.austenite_finish - rig.austenite_start
    cooling_band = rig.martensite_start - rig.martensite_finish
    steepest = np.pi / 2.0 / min(heating_band, cooling_band)
    wire_may_turn_between_samples = 2e-3
    change = np.abs(np.diff(truth.martensite))
    assert np.all(change <= steepest * np.abs(np.diff(truth.wire)) + wire_may_turn_between_samples)

    onset = rig.austenite_start + truth.stress / rig.austenite_slope
    return_onset = rig.martensite_start + truth.stress / rig.martensite_slope
    assert np.all(truth.martensite <= remaining((truth.wire - onset) / heating_band) + 1e-9)
    assert np.all(1.0 - truth.martensite <= remaining((return_onset - truth.wire) / cooling_band) + 1e-9)


@settings(max_examples=30, deadline=None)
@given(rigs, voltages)
def test_heating_only_consumes_martensite_and_cooling_only_forms_it(rig: SmaRig, voltage: np.ndarray) -> None:
    truth = rig.simulate(np.arange(voltage.size) * 0.1, voltage)
    warmer, formed = np.diff(truth.wire), np.diff(truth.martensite)
    # a sample in which the wire turns may do a little of both
    steady = np.concatenate([[False], warmer[1:] * warmer[:-1] > 0.0]) & np.concatenate(
        [warmer[1:] * warmer[:-1] > 0.0, [False]]
    )
    assert np.all(formed[steady & (warmer > 0.0)] <= 1e-9)
    assert np.all(formed[steady & (warmer < 0.0)] >= -1e-9)


@settings(max_examples=30, deadline=None)
@given(rigs, voltages)
def test_angle_falls_with_martensite_and_stays_between_its_ends(rig: SmaRig, voltage: np.ndarray) -> None:
    truth = rig.simulate(np.arange(voltage.size) * 0.1, voltage)
    order = np.argsort(truth.martensite)
    assert np.all(np.diff(truth.angle[order]) <= 1e-9)
    assert np.all(np.diff(truth.stress[order]) <= 1e-3)
    assert truth.angle.min() >= -1e-9


@settings(max_examples=20, deadline=None)
@given(voltages)
def test_temperatures_stay_between_ambient_and_the_hottest_rest_state(voltage: np.ndarray) -> None:
    rig = SmaRig()
    truth = rig.simulate(np.arange(voltage.size) * 0.1, voltage)
    hottest = rig.ambient + voltage.max() ** 2 / (rig.resistance * rig.wire_length * rig.convection)
    for temperature in (truth.jacket, truth.wire, truth.reading):
        assert np.all((temperature >= rig.ambient - 1e-6) & (temperature <= hottest + 1e-6))

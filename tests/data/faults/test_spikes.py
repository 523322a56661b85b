"""Spikes are found where they were put, nowhere else, and bridged by what was there before."""

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.data.faults.spikes import distances, spikes, spikes_told, without_spikes
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 4.0, 900)


def record(output, drive=None, time=TIME):
    return Record(time, np.sin(2.0 * np.pi * time) if drive is None else drive, output, "r")


def noise(rms, seed=0):
    return rms * np.random.default_rng(seed).standard_normal(TIME.size)


@pytest.mark.parametrize("model", ["bouc-wen", "jiles-atherton", "dahl"])
@pytest.mark.parametrize("experiment", HiddenEffects.experiments)
def test_spikes_are_found_where_they_were_put(model, experiment):
    given = {"model": model, "draw": 3}
    clean, spiked = (
        measure("hidden-effects", experiment, settings={**given, "imperfect": kind}, seed=3).records[0]
        for kind in ("", "spiked")
    )
    put, found = np.flatnonzero(spiked.output != clean.output), spikes(spiked)
    assert set(found) <= set(put)
    assert found.size >= put.size - 1  # one of 20 times the noise may hide in a fast movement
    again = without_spikes(Dataset((spiked,))).records[0]
    left = np.abs(again.output - clean.output)[found]
    assert np.max(left) < 0.25 * np.min(np.abs(spiked.output - clean.output)[found])
    untouched = np.setdiff1d(np.arange(clean.time.size), found)
    np.testing.assert_array_equal(again.output[untouched], spiked.output[untouched])


@pytest.mark.parametrize("imperfect", ["", "coloured", "quantised", "noisy-input", "uneven", "coarse"])
@pytest.mark.parametrize("experiment", HiddenEffects.experiments)
def test_no_other_fault_is_taken_for_a_spike(imperfect, experiment):
    for draw in range(3):
        made = measure("hidden-effects", experiment, settings={"imperfect": imperfect, "draw": draw}, seed=draw)
        assert spikes(made.records[0]).size == 0
        assert without_spikes(made).notes == made.notes


@pytest.mark.parametrize("seed", range(4))
def test_steps_kinks_relays_and_heavy_tails_are_left_alone(seed):
    rng = np.random.default_rng(seed)
    steps = np.repeat(rng.standard_normal(30), 30)
    triangle = np.abs((TIME * rng.uniform(1.0, 3.0)) % 1.0 - 0.5)
    relay = np.sign(np.sin(2.0 * np.pi * TIME * rng.uniform(0.5, 9.0)))
    laplace = np.sin(2.0 * np.pi * TIME) + 0.01 * rng.laplace(size=TIME.size)
    counter = np.floor(3.0 * np.sin(2.0 * np.pi * TIME))
    for output in (steps, triangle, relay, laplace, counter):
        for rms in (0.0, 1e-3):
            assert spikes(record(output + noise(rms, seed))).size == 0


@pytest.mark.parametrize("samples", [80, 100, 130, 900])
def test_a_jump_at_every_reversal_is_the_devices_own(samples):
    for seed in range(10):
        time = np.linspace(0.0, 2.0, samples)
        drive = np.sin(2.0 * np.pi * (time + np.random.default_rng(seed).random()))
        jump = np.sign(np.gradient(drive)) * np.random.default_rng(seed).uniform(0.01, 0.5)
        noise = 0.002 * np.random.default_rng(seed).standard_normal(samples)
        assert spikes(record(drive + jump + noise, drive, time)).size == 0


def test_what_the_input_does_is_no_spike():
    drive = np.sin(2.0 * np.pi * TIME)
    drive[400] += 5.0
    followed = np.sin(2.0 * np.pi * TIME) + noise(0.01)
    followed[400] += 2.0
    assert spikes(record(followed, drive)).size == 0
    assert spikes(record(followed)).tolist() == [400]


def test_many_are_no_lone_samples_and_none_is_touched():
    output = np.sin(2.0 * np.pi * TIME) + noise(0.001)
    output[5::20] += 1.0
    assert spikes(record(output)).size == 0


def test_near_spikes_are_bridged_and_an_end_without_neighbours_is_left_as_it_is():
    output = np.sin(2.0 * np.pi * TIME) + noise(0.001)
    spiked = output.copy()
    spiked[[0, 300, 310, 899]] += [1.0, 1.0, -1.0, 1.0]
    data = without_spikes(Dataset((record(spiked),)))
    assert np.max(np.abs(data.records[0].output - output)[1:-1]) < 0.05
    assert data.records[0].output[0] == spiked[0]
    assert "2 samples lie far off their neighbours" in data.notes[0]


@pytest.mark.parametrize("apart", [2, 3, 4, 5])
@pytest.mark.parametrize("other", [-1.1, -0.4, 0.9, 1.0])
def test_two_spikes_do_not_hide_each_other(apart, other):
    output = np.sin(2.0 * np.pi * TIME) + noise(0.001)
    spiked = output.copy()
    spiked[[300, 300 + apart]] += [1.0, other]
    assert spikes(record(spiked)).tolist() == [300, 300 + apart]


@pytest.mark.parametrize("width", [2, 3, 4])
def test_a_pulse_is_left_alone(width):
    output = np.sin(2.0 * np.pi * TIME) + noise(0.001)
    output[300 : 300 + width] += 1.0
    assert spikes(record(output)).size == 0


def test_a_cubic_is_followed_on_any_grid_and_the_sentence_names_the_time():
    time = np.sort(np.random.default_rng(1).random(40))
    assert np.max(np.abs(distances(time, 1.0 + time - 3.0 * time**3)[0])) < 1e-9
    output = np.sin(TIME)
    output[450] += 1.0
    assert f"(at time {TIME[450]:.6g})" in spikes_told(record(output))
    assert spikes_told(record(np.sin(TIME))) == ""
    for tiny in (record(np.zeros(TIME.size)), Record(np.arange(3.0), np.zeros(3), np.array([0.0, 9.0, 0.0]), "r")):
        assert spikes(tiny).size == 0


@pytest.mark.parametrize("seed", range(6))
def test_of_uneven_samples_none_is_bridged_for_one_beside_it(seed):
    rng = np.random.default_rng(seed)
    time = np.sort(rng.uniform(0.0, 8.0, 1200))
    clean = 2.0 * np.sin(2.0 * np.pi * 1.1 * time) + 0.2 * np.abs(np.sin(2.0 * np.pi * 1.1 * time))
    off, at = np.zeros(1200), rng.choice(1200, 18, replace=False)
    off[at] = rng.choice([-1.0, 1.0], 18) * rng.uniform(0.5, 1.5, 18)
    read = Record(time, np.sin(2.0 * np.pi * 1.1 * time), clean + off + 0.03 * rng.standard_normal(1200))
    found = spikes(read)
    assert found.size >= 5
    assert {*found.tolist()} <= {*at.tolist()}
    (bridged,) = without_spikes(Dataset((read,))).records
    assert np.max(np.abs(bridged.output - clean)[found] / np.abs(off)[found]) < 0.5

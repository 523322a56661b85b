"""Records: parts, history, and loops repeated until they settle."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record, Signal


def loop():
    time = np.arange(8) * 0.5
    return Record(time, np.sin(time), np.cos(time), columns={"temperature": time + 20})


def test_settled_repeats_the_loop_as_history():
    settled = loop().settled(2)
    assert settled.time.size == 24
    assert np.all(np.diff(settled.time) > 0)
    assert np.allclose(np.diff(settled.time), 0.5)
    assert np.array_equal(settled.time[settled.scored], loop().time)
    assert np.array_equal(settled.measured, loop().output)
    assert np.array_equal(settled.input[:8], settled.input[16:])


def test_a_part_keeps_its_share_of_the_history():
    part = loop().skip(1.5).take(slice(2, 6))
    assert part.history == 1
    assert part.columns["temperature"].tolist() == [21, 21.5, 22, 22.5]
    assert part.measured.size == 3


def test_an_input_shared_by_the_swarm_is_one_column():
    assert loop().signal.input.shape == (8, 1)
    assert loop().signal.input.flags.c_contiguous


@pytest.mark.parametrize("time", [[0.0, 0.0, 1.0], [0.0, 2.0, 1.0], [0.0, np.nan, 1.0], [0.0, 1.0, np.inf]])
def test_a_time_that_does_not_increase_is_refused(time):
    with pytest.raises(UserError, match="record up: its times must be finite and strictly increase"):
        Record(np.array(time), np.zeros(3), None, "up")


def test_a_smooth_input_is_simulated_along_a_curve_and_answers_at_its_samples():
    time = np.sort(np.random.default_rng(2).uniform(0.0, 6.0, 120))
    record = Record(time, np.sin(time), None, columns={"temperature": 2.0 * time}, steps=4)
    signal = record.signal
    assert signal.time.size == 4 * 119 + 1
    assert np.allclose(record.at_samples(signal.time), time, rtol=0, atol=1e-12)
    straight = np.interp(signal.time, time, record.input)
    missed = [np.max(np.abs(way - np.sin(signal.time))) for way in (signal.input[:, 0], straight)]
    assert missed[0] < 0.02 * missed[1]
    assert np.allclose(signal.columns["temperature"], 2.0 * signal.time)


def corners(time):
    return np.abs(np.mod(time, 2.0) - 1.0)


def noise(time):
    return np.random.default_rng(3).standard_normal(time.size)


@pytest.mark.parametrize("drive", [corners, noise, np.sign])
def test_corners_and_noise_lie_on_straight_lines(drive):
    time = np.linspace(-3.0, 3.0, 121)
    signal = Record(time, drive(time), None, steps=2).signal
    assert np.allclose(signal.input[1::2, 0], 0.5 * (drive(time)[1:] + drive(time)[:-1]))


def test_a_law_of_finer_steps_is_the_finely_sampled_one():
    """The same Bouc-Wen loop from 30 samples a cycle, simulated finely, and from 240."""
    time = np.linspace(0.0, 3.0, 721)
    system = System(registry.build("models", "bouc-wen"))
    values = np.array([[0.6], [0.35], [0.15], [1.3]])
    fine = Record(time, 2.0 * np.sin(2.0 * np.pi * time), None)
    coarse = fine.take(slice(None, None, 8))
    expected = system.respond(fine, values)[::8]
    off = [np.max(np.abs(system.respond(one, values) - expected)) for one in (coarse, replace(coarse, steps=8))]
    assert off[1] < 0.05 * off[0]


def test_a_signal_is_refined_once():
    time = np.array([0.0, 0.1, 0.3, 0.4, 0.6])
    signal = Signal(time, (time**3)[:, None])
    instants, force = signal.finer(4)
    np.testing.assert_allclose(instants[::4], time, rtol=1e-15)
    np.testing.assert_allclose(force[:, 0], instants**3, atol=1e-15)
    assert signal.finer(4)[1] is force
    assert signal.with_input(2.0 * signal.input).finer(4)[1][-1, 0] == pytest.approx(2.0 * 0.6**3)
    assert signal.finer(1)[1] is signal.input


def test_records_of_one_name_are_no_data_set():
    """By its name a record is held out: with it the other of that name would be, without a word."""
    one = Record(np.arange(3.0), np.arange(3.0), np.arange(3.0))
    with pytest.raises(UserError, match="several records are named 'record'"):
        Dataset((one, one))


def test_unknown_records_to_hold_out_are_told_together():
    data = Dataset(tuple(Record(np.arange(3.0), np.arange(3.0), np.arange(3.0), name) for name in ("slow", "fast")))
    with pytest.raises(ValueError, match=r"^no record 'quick'; there are: slow, fast$"):
        data.split(["quick", "fast"])
    with pytest.raises(ValueError, match=r"^no records 'quick', 'slo'; there are: slow, fast$"):
        data.split(["quick", "slo"])

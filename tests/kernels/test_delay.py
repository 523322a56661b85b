"""The compiled delay against numpy's interpolation."""

import numpy as np

from hysteresis_bench.kernels import delay as kernels
from tests.conftest import as_models_call

delay = as_models_call(kernels.delay, 0)


def test_it_is_linear_interpolation_of_the_past():
    rng = np.random.default_rng(1)
    u = rng.normal(size=(200, 5))
    durations = np.array([0.0, 1e-6, 0.03, 0.7, 1e3])
    even = np.arange(200) * 0.05
    rounded, jittered, uneven = (
        even.round(1) + 1e-3 * even,
        even + rng.uniform(-0.02, 0.02, 200),
        rng.uniform(0.001, 0.1, 200),
    )
    for time in (even, rounded, jittered, np.cumsum(uneven), np.logspace(-9, 1, 200), 1e4 + np.arange(200) / 300):
        for inputs in (u, u[:, :1].copy()):
            v = delay(time, inputs, durations)
            for j, duration in enumerate(durations):
                expected = np.interp(time - duration, time, inputs[:, j % inputs.shape[1]])
                np.testing.assert_allclose(v[:, j], expected, atol=1e-15 * max(1e3, time[-1] / (time[1] - time[0])))


def test_no_delay_is_the_input_to_the_last_bit():
    time = np.linspace(0.0, 1.0, 77)
    u = np.random.default_rng(2).normal(size=(77, 2))
    assert np.array_equal(delay(time, u, np.zeros(2)), u)


def test_two_samples_and_one():
    u = np.array([[1.0], [3.0]])
    assert np.array_equal(delay(np.array([0.0, 1.0]), u, np.array([0.25]))[:, 0], [1.0, 2.5])
    assert np.array_equal(delay(np.array([5.0]), u[:1], np.array([0.25]))[:, 0], [1.0])


def test_a_delay_by_whole_steps_is_a_shift():
    time = np.arange(50) * 0.25
    u = np.random.default_rng(3).normal(size=(50, 1))
    shifted = np.concatenate([np.repeat(u[:1], 4, axis=0), u[:-4]])
    assert np.array_equal(delay(time, u, np.array([1.0])), shifted)


def test_read_only_records_are_taken_on_any_grid():
    time = np.cumsum(np.random.default_rng(4).uniform(0.5, 1.5, 40))
    u, duration = np.sin(time)[:, None], np.array([0.0, 0.3, 2.7])
    expected = delay(time, u, duration)
    u.setflags(write=False)
    assert np.array_equal(delay(time, u, duration), expected)

"""The compiled sinusoid against numpy's cosine and sine."""

import numpy as np
import pytest

from hysteresis_bench.kernels.sinusoid import add_sinusoid

COSINE, SINE = np.array([1.0, 0.0, -0.4, 0.0]), np.array([0.0, 1.0, 2.5, 0.0])
FREQUENCY = np.array([0.3, 49.7, 499.0, 50.0])


@pytest.mark.parametrize("begin", [0.0, -3.3, 1e4])
@pytest.mark.parametrize("uneven", [False, True])
def test_it_agrees_with_cosine_and_sine(begin, uneven):
    rng = np.random.default_rng(1)
    time = begin + np.arange(25_000) * 1e-3 + (rng.uniform(-4e-4, 4e-4, 25_000) if uneven else 0.0)
    phase = 2 * np.pi * FREQUENCY * time[:, None]
    expected = COSINE * np.cos(phase) + SINE * np.sin(phase)
    np.testing.assert_allclose(sinusoid(time, COSINE, SINE, FREQUENCY), expected, rtol=0, atol=1e-6)


def sinusoid(time, cosine, sine, frequency):
    alone = np.zeros((time.size, frequency.size))
    add_sinusoid(alone, time, cosine, sine, frequency)
    return alone


def test_a_change_of_the_step_is_followed():
    time = np.concatenate([np.arange(0, 1, 0.01), np.arange(1, 3, 0.03), np.arange(3, 4, 0.01)])
    expected = np.cos(2 * np.pi * 5.1 * time)[:, None]
    one = np.ones(1)
    np.testing.assert_allclose(sinusoid(time, one, 0 * one, 5.1 * one), expected, atol=1e-12)


def test_no_amplitude_is_nothing():
    assert np.all(sinusoid(np.linspace(0, 1, 200), np.zeros(3), np.zeros(3), FREQUENCY[:3]) == 0.0)

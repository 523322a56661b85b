"""The elementary functions of the kernels against numpy's."""

import numpy as np
from numba import njit

from hysteresis_bench.kernels.elementary import (
    base_2_logarithm,
    base_2_logarithm_to_2,
    cosine_and_sine,
    exponential,
    exponential_less_1,
    logarithm,
    power_of_2,
)


@njit(error_model="numpy", fastmath={"contract"})
def every(x, exponentials, logarithms):
    for i in range(x.size):
        exponentials[i] = exponential(x[i])
        logarithms[i] = logarithm(abs(x[i]))


def computed(x):
    exponentials, logarithms = np.empty_like(x), np.empty_like(x)
    every(x, exponentials, logarithms)
    return exponentials, logarithms


def test_both_are_as_exact_as_they_say():
    rng = np.random.default_rng(0)
    x = np.concatenate([rng.uniform(-700, 700, 20_000), rng.uniform(-2, 2, 20_000), rng.normal(size=5000) * 1e-9])
    exponentials, logarithms = computed(x)
    np.testing.assert_allclose(exponentials, np.exp(x), rtol=5e-16, atol=0)
    expected = np.log(np.abs(x))
    assert np.max(np.abs(logarithms - expected) / np.maximum(np.abs(expected), 1.0)) < 4e-16
    sizes = 10.0 ** np.arange(-307, 308)
    np.testing.assert_allclose(computed(sizes)[1], np.log(sizes), rtol=4e-16)


def test_the_ends_are_kept():
    exponentials, logarithms = computed(np.array([0.0, -1e5, 1e5, 1.0]))
    assert exponentials[0] == 1.0
    assert 0.0 <= exponentials[1] < 1e-307
    assert 1e307 < exponentials[2] < np.inf
    assert logarithms[0] < -708
    assert logarithms[3] == 0.0


def test_the_exponential_less_1_keeps_its_digits_near_0():
    less_1 = njit(lambda x: exponential_less_1(x))
    rng = np.random.default_rng(1)
    x = np.concatenate([rng.uniform(-700, 700, 5000), rng.uniform(-2, 2, 20_000), 10.0 ** rng.uniform(-200, 0, 5000)])
    np.testing.assert_allclose([less_1(value) for value in x], np.expm1(x), rtol=2e-15, atol=0)
    assert less_1(0.0) == 0.0
    assert less_1(-1e5) == -1.0
    assert 1e307 < less_1(1e5) < np.inf


def test_those_of_base_2():
    power, general = njit(lambda x: power_of_2(x)), njit(lambda x: base_2_logarithm(x))
    x = -np.random.default_rng(2).uniform(0.0, 1020.0, 5000)
    np.testing.assert_allclose([power(value) for value in x], np.exp2(x), rtol=1e-15, atol=0)
    assert [power(0.0), power(-1.0), power(-1e9)] == [1.0, 0.5, 2.0**-1022]
    sizes = np.concatenate([np.exp2(x), np.exp2(-x), np.exp2(x / 1020.0)])
    expected = np.log2(sizes)
    found = np.array([general(value) for value in sizes])
    assert np.max(np.abs(found - expected) / np.maximum(np.abs(expected), 1.0)) < 1e-15


def test_the_logarithm_to_2_is_the_logarithm():
    x = np.concatenate([1.0 + np.linspace(0.0, 1.0, 10001), 1.0 + 2.0 ** -np.arange(1.0, 53.0)])
    general, short = njit(lambda x: base_2_logarithm(x)), njit(lambda x: base_2_logarithm_to_2(x))
    assert [short(value) for value in x] == [general(value) for value in x]


def test_cosine_and_sine_of_turns():
    pair = njit(lambda x: cosine_and_sine(x), error_model="numpy")
    eighth = np.random.default_rng(1).uniform(-0.125, 0.125, 2000)
    cosine, sine = np.cos(2 * np.pi * eighth), np.sin(2 * np.pi * eighth)
    for quarters, expected in enumerate([(cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine)]):
        for whole in (-3.0, 0.0, 1e3):
            turns = eighth + (whole + 0.25 * quarters)
            rounded = 2 * np.pi * np.max(np.abs(turns - (whole + 0.25 * quarters) - eighth))
            found = np.array([pair(x) for x in turns]).T
            np.testing.assert_allclose(found, expected, rtol=0, atol=6e-16 + rounded)
    assert pair(0.0) == (1.0, 0.0)

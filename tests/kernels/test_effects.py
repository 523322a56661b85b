"""The effects' kernels against the plain formulas, and to the last bit where they are switched off."""

import numpy as np
import pytest

from hysteresis_bench.kernels.delay import delay
from hysteresis_bench.kernels.effects.asymmetry import bend
from hysteresis_bench.kernels.effects.curve_in_time import add, products, scale_and_add
from hysteresis_bench.kernels.effects.fatigue import fade
from hysteresis_bench.kernels.effects.saturation import saturate
from hysteresis_bench.kernels.ripple import add_ripple
from hysteresis_bench.kernels.rounded_dead_zone import rounded_dead_zone
from hysteresis_bench.kernels.sinusoid import add_sinusoid
from hysteresis_bench.signals import read_only

SWARM = 13
OFF = np.zeros(SWARM)


@pytest.fixture
def y():
    return np.cumsum(np.random.default_rng(1).normal(size=(300, SWARM)), axis=0)


def drawn(seed, low, high):
    return np.random.default_rng(seed).uniform(low, high, SWARM)


def saturated(y, inverse_level, sharpness):
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        excess = np.abs(inverse_level * y)
        folded = np.exp(-np.log1p(np.minimum(excess, 1.0 / excess) ** sharpness) / sharpness)
        return np.where(excess <= 1.0, y * folded, np.sign(y) * folded / inverse_level)


@pytest.mark.parametrize("size", [1e-6, 1e-2, 1.0, 1e4, 1e300])
def test_saturation(y, size):
    y *= size
    y[5], y[7, 0] = 0.0, np.nan
    for inverse_level in (drawn(2, 0.0, 1.0), drawn(2, 0.0, 1.0) / size, 1e9 * drawn(2, 0.5, 1.0)):
        sharpness = np.geomspace(1.0, 1000.0, SWARM)
        expected, found = saturated(y, inverse_level, sharpness), y.copy()
        saturate(found, inverse_level, sharpness)
        np.testing.assert_allclose(found, expected, rtol=1e-14, atol=0)


def test_saturation_of_an_infinite_output_is_the_level():
    found = np.array([[np.inf, -np.inf, 1e308, -1e308]])
    saturate(found, np.array([2.0, 2.0, 1e10, 1e10]), np.full(4, 3.0))
    np.testing.assert_allclose(found, [[0.5, -0.5, 1e-10, -1e-10]], rtol=1e-15)


@pytest.mark.parametrize("own", [False, True])
def test_dead_zone(y, own):
    x = y if own else y[:, :1].copy()
    share, half_width = drawn(4, 0.5, 1.2), drawn(5, 0.0, 5.0)
    centre, rounding = drawn(6, -3.0, 3.0), drawn(7, 0.0, 1.0)
    rounding[:4] = 0.0

    def held(d):
        return 0.5 * (np.hypot(d + half_width, rounding) - np.hypot(d - half_width, rounding))

    expected = x - share * (held(x - centre) - held(-centre))
    np.testing.assert_allclose(rounded_dead_zone(x, share, half_width, centre, rounding), expected, atol=1e-13)
    sharp = rounded_dead_zone(x, share, half_width, OFF, OFF)
    np.testing.assert_allclose(sharp, x - share * np.clip(x, -half_width, half_width), atol=1e-14)
    off = rounded_dead_zone(x, share, OFF, centre, rounding)
    np.testing.assert_array_equal(off, np.broadcast_to(x, off.shape))


@pytest.mark.parametrize("own", [False, True])
def test_fatigue(y, own):
    u = y[:, ::-1].copy() if own else y[:, :1].copy()
    rate, found = drawn(3, 0.0, 0.1), y.copy()
    path = np.cumsum(np.abs(np.diff(u, axis=0, prepend=u[:1])), axis=0)
    fade(found, u, rate)
    np.testing.assert_allclose(found, y * np.exp(-rate * path), rtol=1e-13)


def test_temperature_and_drift(y):
    course, gain, rate = np.random.default_rng(4).normal(size=300), drawn(5, -1, 1), drawn(6, -1, 1)
    warm, drifting = y.copy(), y.copy()
    scale_and_add(warm, course, gain, rate)
    np.testing.assert_allclose(warm, y * (1.0 + gain * course[:, None]) + rate * course[:, None], rtol=1e-13)
    add(drifting, course, rate)
    assert np.array_equal(drifting, y + rate * course[:, None])


def test_what_a_record_s_offset_and_drift_are_estimated_from(y):
    course = np.random.default_rng(7).normal(size=300)
    np.testing.assert_allclose(products(y, course), course @ y, rtol=0, atol=1e-13 * np.abs(course).sum() * np.ptp(y))
    np.testing.assert_allclose(products(y, np.full(300, 1 / 300)), y.mean(axis=0), rtol=1e-13)
    inside = slice(20, 300)
    assert np.array_equal(products(y[inside], course[inside]), products(y[inside].copy(), course[inside]))


@pytest.mark.parametrize("own", [False, True])
def test_asymmetry(y, own):
    u, curvature = y if own else y[:, :1].copy(), drawn(8, -1, 1)
    assert np.array_equal(bend(u, curvature), curvature * u**2 + u)


def test_periodic_disturbance(y):
    time, cosine, sine, frequency = np.arange(300) * 0.01, drawn(9, -1, 1), drawn(10, -1, 1), drawn(11, 1, 40)
    phase, found = 2 * np.pi * frequency * time[:, None], y.copy()
    add_sinusoid(found, time, cosine, sine, frequency)
    np.testing.assert_allclose(found, y + cosine * np.cos(phase) + sine * np.sin(phase), rtol=0, atol=1e-12)


def test_each_is_off_to_the_last_bit_at_its_null(y):
    course, sharp = np.random.default_rng(12).normal(size=300), drawn(13, 1, 20)
    offs = (
        lambda of: saturate(of, OFF, sharp),
        lambda of: fade(of, y, OFF),
        lambda of: scale_and_add(of, course, OFF, OFF),
        lambda of: add(of, course, OFF),
        lambda of: add_sinusoid(of, course, OFF, OFF, sharp),
    )
    for scale in (1e-300, 1.0, 1e300):
        for off in offs:
            same = scale * y
            off(same)
            assert np.array_equal(same, scale * y)
        assert np.array_equal(bend(1e-9 * y, OFF), 1e-9 * y)
        assert np.array_equal(delay(read_only(np.arange(300.0)), scale * y, OFF), scale * y)


def test_what_is_not_overwritten_stays(y):
    course, rate, kept = np.ones(300), drawn(14, 0, 1), y.copy()
    fade(y.copy(), y, rate)
    bend(y, rate)
    products(y, course)
    assert np.array_equal(y, kept)
    assert np.array_equal(course, np.ones(300))


@pytest.mark.parametrize("along", ["the input", "columns of their own", "the response itself"])
def test_a_ripple_is_its_harmonics(along):
    rng = np.random.default_rng(5)
    y, period = rng.normal(size=(40, 9)), rng.uniform(0.05, 2.0, 9)
    waves = rng.normal(size=(6, 9))
    waves[:, 4] = 0.0
    course = {"the input": rng.normal(size=(40, 1)), "columns of their own": 3.0 * rng.normal(size=(40, 9))}.get(
        along, y
    )
    w = 2.0 * np.pi * course / period
    known = y + sum(waves[2 * n] * np.sin((n + 1) * w) + waves[2 * n + 1] * np.cos((n + 1) * w) for n in range(3))
    found = y.copy()
    add_ripple(found, found if along == "the response itself" else course, period, waves)
    np.testing.assert_allclose(found, known, atol=1e-12)
    np.testing.assert_array_equal(found[:, 4], y[:, 4])

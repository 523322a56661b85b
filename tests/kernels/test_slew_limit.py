"""A limit on how fast a signal is followed, against a fine grid, closed forms and what it must keep."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hysteresis_bench.kernels.slew_limit import slew_limited


def limited(time, u, rising, falling):
    return slew_limited(time, u[:, None], np.array([rising]), np.array([falling]))[:, 0]


def on_a_fine_grid(time, u, rising, falling, parts=2000):
    """A little at a time, in plain Python."""
    v, found = u[0], [u[0]]
    for i in range(1, time.size):
        step = (time[i] - time[i - 1]) / parts
        for part in range(1, parts + 1):
            goal = u[i - 1] + (u[i] - u[i - 1]) * part / parts
            v = min(max(goal, v - step / falling), v + step / rising)
        found.append(v)
    return np.array(found)


@pytest.mark.parametrize(("rising", "falling"), [(0.3, 0.3), (0.8, 1.6), (2.0, 0.7), (5.0, 5.0)])
def test_agrees_with_its_definition_on_a_fine_grid(rising, falling):
    rng = np.random.default_rng(3)
    time = np.cumsum(rng.uniform(0.2, 1.8, 80))
    u = np.cumsum(rng.normal(size=80))
    found = limited(time, u, rising, falling)
    # where it falls behind on the way, the grid does so a part later
    np.testing.assert_allclose(found, on_a_fine_grid(time, u, rising, falling), rtol=0, atol=5e-3)
    finer = np.abs(found - on_a_fine_grid(time, u, rising, falling, 8000)).max()
    assert finer < 0.5 * np.abs(found - on_a_fine_grid(time, u, rising, falling)).max() + 1e-12


def test_a_triangle_that_is_too_fast_is_followed_by_a_smaller_one():
    """From rest at 0 up to 1 and down again at the rate 1, followed at the rate 1/2: met half-way down."""
    time = np.array([0.0, 1.0, 1.25, 4 / 3, 2.0, 3.0])
    u = np.array([0.0, 1.0, 0.75, 2 / 3, 0.0, -1.0])
    np.testing.assert_allclose(limited(time, u, 2.0, 2.0), [0.0, 0.5, 0.625, 2 / 3, 1 / 3, -1 / 6], atol=1e-14)
    # the same, met between two samples
    np.testing.assert_allclose(
        limited(time[[0, 1, 4, 5]], u[[0, 1, 4, 5]], 2.0, 2.0), [0.0, 0.5, 1 / 3, -1 / 6], atol=1e-14
    )


def test_what_is_slow_enough_is_left_to_the_last_bit():
    time = np.linspace(0.0, 10.0, 400)
    u = np.sin(time)
    np.testing.assert_array_equal(limited(time, u, 0.99, 0.99), u)
    np.testing.assert_array_equal(limited(time, 1e9 * u, 0.0, 0.0), 1e9 * u)


def test_columns_of_the_input_and_of_the_limits_belong_together():
    rng = np.random.default_rng(5)
    time, u = np.arange(50.0), rng.normal(size=(50, 3)).cumsum(axis=0)
    rising, falling = rng.uniform(0.5, 3.0, (2, 3))
    together = slew_limited(time, u, rising, falling)
    for j in range(3):
        np.testing.assert_array_equal(together[:, j], limited(time, u[:, j], rising[j], falling[j]))


@given(st.integers(0, 10_000), st.floats(0.05, 5.0), st.floats(0.05, 5.0))
def test_it_is_never_faster_and_never_beyond_the_input(seed, rising, falling):
    rng = np.random.default_rng(seed)
    time = np.cumsum(rng.uniform(0.1, 2.0, 60))
    u = rng.normal(size=60).cumsum()
    v = limited(time, u, rising, falling)
    speed = np.diff(v) / np.diff(time)
    assert speed.max() <= (1.0 + 1e-9) / rising
    assert speed.min() >= -(1.0 + 1e-9) / falling
    assert u.min() - 1e-12 <= v.min()
    assert v.max() <= u.max() + 1e-12


@given(st.integers(0, 10_000))
def test_a_limit_on_top_of_a_harder_one_does_nothing(seed):
    rng = np.random.default_rng(seed)
    time = np.arange(60.0)
    v = limited(time, rng.normal(size=60).cumsum(), 2.0, 3.0)
    # between its samples what follows has bends, of which the samples know nothing: it is slower than its limit there
    np.testing.assert_allclose(limited(time, v, 1.9, 2.9), v, rtol=0, atol=1e-12)


def test_more_samples_of_the_same_line_change_nothing():
    rng = np.random.default_rng(9)
    time, u = np.arange(40.0), rng.normal(size=40).cumsum()
    fine = np.linspace(0.0, 39.0, 39 * 7 + 1)
    found = limited(fine, np.interp(fine, time, u), 1.5, 0.8)
    np.testing.assert_allclose(found[::7], limited(time, u, 1.5, 0.8), rtol=0, atol=1e-12)

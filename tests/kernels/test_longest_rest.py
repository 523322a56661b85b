"""The longest rest, beside a plain search over all windows."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hysteresis_bench.kernels.longest_rest import longest_rest


def plain(time, u, width):
    """Every window."""
    size = u.size
    windows = [(i, j) for i in range(size) for j in range(i, size) if np.ptp(u[i : j + 1]) <= width]
    return max((time[j] - time[i] for i, j in windows), default=0.0)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-5, 5), min_size=0, max_size=25), st.integers(0, 6), st.integers(0, 99))
def test_it_is_that_of_all_windows(values, width, seed):
    u = np.array(values, dtype=float)
    time = np.cumsum(np.random.default_rng(seed).random(u.size))
    assert longest_rest(time, u, float(width)) == pytest.approx(plain(time, u, width))


def test_a_sine_rests_where_it_turns():
    time = np.linspace(0.0, 2.0, 20001)
    # within a hundredth of its range it stays while the cosine is above 0.98
    assert longest_rest(time, np.sin(2.0 * np.pi * time), 0.02) == pytest.approx(
        2.0 * np.arccos(0.98) / (2.0 * np.pi), rel=5e-3
    )


def test_a_step_ends_it():
    time = np.arange(10.0)
    assert longest_rest(time, np.repeat([0.0, 1.0], [4, 6]), 0.1) == 5.0
    assert longest_rest(time, np.zeros(10), 0.0) == 9.0

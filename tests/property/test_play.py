"""The identity under the free-energy kernel: for one H_c, the relays that are up are those with H_I > -P."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hysteresis_bench.kernels.free_energy import magnetization

# multiples of 1/8, so that sums are exact and a field can meet a threshold exactly
EIGHTHS = st.integers(-64, 64).map(lambda n: n / 8)
INPUTS = st.lists(EIGHTHS, min_size=1, max_size=40)
RADII = st.integers(1, 40).map(lambda n: n / 8)
INTERACTIONS = (np.arange(-2000, 2000) + 0.5) / 128


def play(h, radius, p):
    return max(h - radius, min(h + radius, p))


@given(INPUTS, RADII)
def test_relays_up_are_an_upper_set_that_follows_the_play(inputs, radius):
    up, p = INTERACTIONS > 0.0, 0.0
    for h in inputs:
        effective = h + INTERACTIONS
        up = np.where(effective >= radius, True, np.where(effective <= -radius, False, up))  # (3)
        p = play(h, radius, p)
        assert np.array_equal(up, -p < INTERACTIONS)


@given(INPUTS, RADII, RADII)
def test_plays_that_move_have_the_smallest_radii(inputs, one, other):
    small, large = sorted((one, other))
    p, q = 0.0, 0.0
    for h in inputs:
        moved = play(h, small, p) != p, play(h, large, q) != q
        assert moved[0] or not moved[1] or small == large
        p, q = play(h, small, p), play(h, large, q)


@given(INPUTS, RADII)
def test_kernel_follows_the_play(inputs, radius):
    # one class of coercive field, of no spread: its term is erf(P / (b sqrt 2)), read off where it is steep
    field = np.array(inputs)[:, None]
    one = np.ones(1)
    width = 20.0
    found = magnetization(field, 0 * one, one, radius * one, 0 * one, width * one, np.zeros(1), np.ones(1))
    p = 0.0
    for k, h in enumerate(inputs):
        p = play(h, radius, p)
        # erf(x) ~ 2 x / sqrt(pi) (1 - x^2 / 3 + x^4 / 10 - x^6 / 42)
        x = p / (width * np.sqrt(2.0))
        series = 2 * x / np.sqrt(np.pi) * (1 - x**2 / 3 + x**4 / 10 - x**6 / 42 + x**8 / 216)
        assert abs(found[k, 0] - series) < 1e-7


@given(INPUTS, st.lists(st.integers(1, 5), min_size=40, max_size=40))
def test_time_stretch_changes_nothing(inputs, repeats):
    held = np.repeat(inputs, repeats[: len(inputs)])
    last = np.cumsum(repeats[: len(inputs)]) - 1
    settings = [np.array([value]) for value in (0.1, 1.0, 1.0, 0.3, 1.5)]
    nodes = np.linspace(-3.0, 3.0, 11), np.full(11, 1 / 11)
    plain = magnetization(np.array(inputs)[:, None], *settings, *nodes)
    stretched = magnetization(held[:, None], *settings, *nodes)
    np.testing.assert_array_equal(stretched[last], plain)

"""What an inverse promises: the forward model of its answer is the question, on any signal."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from hysteresis_bench.compose import System
from hysteresis_bench.control.inverse import BoucWenInverse, Point
from hysteresis_bench.signals import Signal
from hysteresis_plugins.models.bouc_wen import BoucWen

parameters = st.tuples(st.floats(0.0, 0.95), st.floats(0.01, 5), st.floats(-3, 5), st.floats(0.05, 20))
coarse_steps = st.lists(st.floats(-30, 30), min_size=2, max_size=60)
fine_walks = st.tuples(st.integers(0, 2**32 - 1), st.floats(1e-6, 1.0))


def invertible(drawn, n=1.0):
    alpha, beta, gamma, d = drawn
    assume(beta + gamma > 0.02 and alpha * max(1.0, 2 * beta / (beta + gamma)) < 0.98)
    return BoucWenInverse(alpha, beta, gamma, d, n)


def forward(inverse, u):
    values = np.array([[inverse.alpha], [inverse.beta], [inverse.gamma], [inverse.d]])
    return System(BoucWen(inverse.n)).simulate(Signal(np.arange(float(u.size)), u[:, None]), values)[:, 0]


def round_trip(inverse, v):
    u = inverse.input_for(v)
    assert np.isfinite(u).all()
    return np.abs(forward(inverse, u) - v).max()


@given(parameters, coarse_steps)
@settings(max_examples=200, deadline=None)
def test_coarse_steps_and_reversals_come_back(drawn, steps):
    v = np.array(steps)
    assert round_trip(invertible(drawn), v) < 1e-9


def test_steps_of_many_relaxation_lengths_come_back():
    """e^(gamma - beta times the largest step) overflows here: h falls to 0 within a small part of a sample."""
    inverse = BoucWenInverse(0.61, 0.35, 4.25, 0.44)
    v = np.random.default_rng(0).uniform(-100, 100, 200)
    u = inverse.input_for(v)
    assert (inverse.gamma - inverse.beta) * np.abs(np.diff(u)).max() > 1000
    assert np.abs(forward(inverse, u) - v).max() < 1e-9


@given(parameters, fine_walks)
@settings(max_examples=100, deadline=None)
def test_random_walks_come_back(drawn, walk):
    seed, size = walk
    v = np.cumsum(size * np.random.default_rng(seed).standard_normal(2000))
    assert round_trip(invertible(drawn), v) < 1e-9


@given(parameters, coarse_steps, st.floats(1.0, 4.0))
@settings(max_examples=60, deadline=None)
def test_any_smoothness_comes_back(drawn, steps, n):
    """The forward law is solved to a relative error of 1e-9 to 1e-8 where n is not 1, and what it makes of a jump is in
    all that follows: the worst of some thousands was 1.2e-8."""
    v = np.array(steps) / 10
    assert round_trip(invertible(drawn, n), v) < 3e-8 * max(1.0, np.abs(v).max())


def test_a_loop_that_is_next_to_nothing_comes_back_too():
    """Powers of so small a h underflow: the integration had not ended."""
    inverse = BoucWenInverse(2.2250738585e-313, 3.6775601447935964, 4.834569641451292, 0.05, 3.3333765731099363)
    v = (
        np.array(
            [
                -9.785772955198066,
                -27.013347274830892,
                0.049524651259684305,
                0.049524651259684305,
                -21.64404306680295,
                12.169206156384021,
                0.0,
                1.101907805489226e-213,
                6.0,
                6.0,
                -19.300266060302462,
                0.5,
                6.103515625e-05,
                5.93586473214717e-257,
            ]
        )
        / 10
    )
    assert round_trip(inverse, v) < 1e-12


@given(parameters, coarse_steps)
@settings(max_examples=60, deadline=None)
def test_inputs_come_back_too(drawn, steps):
    inverse, u = invertible(drawn), np.array(steps)
    np.testing.assert_allclose(inverse.input_for(forward(inverse, u)), u, rtol=0, atol=1e-8)


@given(parameters, coarse_steps)
@settings(max_examples=30, deadline=None)
def test_sample_by_sample_is_the_whole_signal(drawn, steps):
    inverse, v = invertible(drawn), np.array(steps)
    point, found = Point(v[0] / inverse.d, 0.0), [v[0] / inverse.d]
    for wanted in v[1:]:
        point = inverse.towards(point, wanted)
        found.append(point.u)
        assert inverse.output(point) == pytest.approx(wanted, abs=1e-9)
    np.testing.assert_array_equal(found, inverse.input_for(v))


@given(parameters)
@settings(max_examples=60, deadline=None)
def test_what_is_refused_is_not_monotonic_and_what_is_not_refused_is(drawn):
    """The forward model itself says which: the slope of v(u), sampled on the major loop and its reversals."""
    alpha, beta, gamma, d = drawn
    assume(beta + gamma > 0.05 and alpha > 0.05)
    share = alpha * max(1.0, 2 * beta / (beta + gamma))
    assume(abs(share - 1.0) > 0.02)
    reach = 12.0 / (beta + gamma)
    u = np.concatenate([np.linspace(0, reach, 4000), np.linspace(reach, -reach, 40_000)])
    values = np.array([[alpha], [beta], [gamma], [d]])
    v = System(BoucWen()).simulate(Signal(np.arange(float(u.size)), u[:, None]), values)[:, 0]
    rises = bool((np.diff(v)[:3999] > 0).all() and (np.diff(v)[4000:] < 0).all())
    try:
        BoucWenInverse(alpha, beta, gamma, d)
        refused = False
    except ValueError:
        refused = True
    assert refused != rises

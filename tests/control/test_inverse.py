"""The Bouc-Wen inverse: what equation (14) is as printed, known cases, refusals."""

import numpy as np
import pytest

from hysteresis_bench.compose import System
from hysteresis_bench.control.inverse import BoucWenInverse, Point
from hysteresis_bench.signals import Signal
from hysteresis_plugins.models.bouc_wen import BoucWen

PUBLISHED = (0.304225, 0.675313, 0.497724, 1.045814)  # PEA paper, Table 2, G-Pmix
time = np.arange(4000) / 1000
reference = 2.0 * np.sin(2 * np.pi * 0.5 * time)


def forward(u, parameters=PUBLISHED):
    return System(BoucWen()).simulate(Signal(time[: u.size], u[:, None]), np.array(parameters)[:, None])[:, 0]


def test_equation_14_with_the_paper_s_names_is_the_forward_model():
    """u0 the reference, u the compensated input: u = d u0 - h doubles the hysteresis instead of removing it."""
    alpha, beta, gamma, d = PUBLISHED
    h, compensated = 0.0, [d * reference[0]]
    for du in np.diff(reference):  # many small Euler steps of the printed rate
        for _ in range(20):
            h += (alpha * d - beta * np.sign(du) * h - gamma * abs(h)) * du / 20
        compensated.append(d * reference[len(compensated)] - h)
    np.testing.assert_allclose(compensated, forward(reference), atol=1e-4)
    assert np.std(forward(np.array(compensated)) - reference) > 0.2


def test_equation_14_with_the_names_exchanged_is_the_inverse():
    """u the reference, u0 the voltage, h driven by u0. With h of the sample before, it is late; solved, it is exact."""
    inverse = BoucWenInverse(*PUBLISHED)
    point, late = Point(0.0, 0.0), []
    for wanted in reference:
        point = inverse.moved(point, (wanted + point.h) / inverse.d)
        late.append(point.u)
    error_late = np.abs(forward(np.array(late)) - reference).max()
    error = np.abs(forward(inverse.input_for(reference)) - reference).max()
    assert error < 1e-12 < 1e-4 < error_late


def test_without_hysteresis_the_inverse_is_a_division():
    np.testing.assert_allclose(BoucWenInverse(0.0, 1.0, 0.5, 4.0).input_for(reference), reference / 4.0, atol=1e-15)


def test_a_wanted_output_that_does_not_move_needs_an_input_that_does_not():
    u = BoucWenInverse(*PUBLISHED).input_for(np.array([0.0, 1.0, 1.0, 1.0]))
    assert u[1] == u[2] == u[3]


def test_extremes_stay_finite_and_exact():
    inverse = BoucWenInverse(*PUBLISHED)
    v = np.array([0.0, 1e6, -1e6, 1e-9, 0.0, -1e-300, 5.0])
    u = inverse.input_for(v)
    assert np.isfinite(u).all()
    np.testing.assert_allclose(forward(u), v, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ((1.2, 0.5, 0.5, 1.0), "not a monotonic function"),
        ((0.7, 5.0, -1.0, 1.0), "not a monotonic function"),
        ((0.3, 0.5, -0.6, 1.0), "beta \\+ gamma = -0.1"),
        ((0.3, 0.0, 0.5, 1.0), "beta = 0 must be above"),
        ((0.3, 0.5, 0.5, 0.0), "d = 0 must be above 0"),
        ((-0.1, 0.5, 0.5, 1.0), "alpha = -0.1"),
        ((-0.1, 0.5, 0.5, -1.0), "d = -1 .*alpha = -0.1"),
        ((float("nan"), 0.5, 0.5, 1.0), "not finite"),
    ],
)
def test_what_has_no_inverse_is_refused_in_words(parameters, words):
    with pytest.raises(ValueError, match=words):
        BoucWenInverse(*parameters)

"""The free forms' kernels against scipy's splines and plain formulas, and to the last bit where they are off."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from hysteresis_bench.kernels.effects.natural_spline import (
    add_spline,
    add_spline_of_own,
    natural_splines,
    scale_by_spline,
)
from hysteresis_bench.kernels.effects.own_phase import add_at_own_phase
from hysteresis_bench.kernels.effects.polynomial_current import ORDERS, collect
from hysteresis_bench.kernels.effects.wave import add_wave

RNG = np.random.default_rng(3)
SAMPLES, SWARM = 400, 13
TIME = 5.0 + np.cumsum(RNG.uniform(0.001, 0.02, SAMPLES))
Y = np.cumsum(RNG.normal(size=(SAMPLES, SWARM)), axis=0)
KNOTS = {"even": tuple(k / 8.0 for k in range(9)), "denser first": tuple((k / 6.0) ** 2 for k in range(7))}


def drawn(low, high):
    return RNG.uniform(low, high, SWARM)


def splines(knots, held, low, high, size=1.0):
    ordinates = size * RNG.normal(size=(len(knots), SWARM))
    return natural_splines(low, high, knots=knots, ordinates=ordinates, held=held), ordinates


def values_of(x, curves):
    found = np.zeros_like(x)
    add_spline_of_own(found, x, curves)
    return found


def plain(x, knots, held, low, high, ordinates):
    """One column by scipy, straight or level beyond the ends."""
    curve = CubicSpline(knots, ordinates, bc_type="natural")
    z = (x - low) / (high - low)
    inside = np.clip(z, 0.0, 1.0)
    return curve(inside) + (0.0 if held else (z - inside) * curve(inside, 1))


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("knots", KNOTS.values(), ids=KNOTS.keys())
def test_natural_splines(knots, held):
    # ranges that differ from column to column, so that one abscissa lies in several pieces
    low, high = drawn(-1.3, -0.7), drawn(0.8, 1.4)
    curves, ordinates = splines(knots, held, low, high)
    own = RNG.uniform(-2.0, 2.0, (SAMPLES, SWARM))
    own[:SWARM] = low
    shared = np.concatenate([own[: SAMPLES // 2, 0], low, high, np.linspace(-2.0, 2.0, SAMPLES // 2 - 2 * SWARM)])
    for j in range(SWARM):
        expected = plain(own[:, j], knots, held, low[j], high[j], ordinates[:, j])
        np.testing.assert_allclose(values_of(own, curves)[:, j], expected, rtol=0, atol=1e-12)
    added, scaled = Y.copy(), Y.copy()
    add_spline(added, shared, curves)
    scale_by_spline(scaled, shared, curves)
    values = values_of(np.repeat(shared[:, None], SWARM, axis=1), curves)
    np.testing.assert_allclose(added, Y + values, rtol=0, atol=1e-12)
    np.testing.assert_allclose(scaled, Y * (1.0 + values), rtol=0, atol=1e-12 * np.abs(Y).max())


def test_a_wave():
    duration, frequency, overtones = drawn(3.0, 4.5), drawn(0.5, 40.0), RNG.normal(size=(4, SWARM))
    knots, zero, expected = KNOTS["even"], np.zeros(SWARM), Y.copy()
    (cosine, a), (sine, b) = (splines(knots, True, zero, duration) for _ in range(2))
    phase, since = 2.0 * np.pi * frequency * TIME[:, None], TIME - TIME[0]
    for j in range(SWARM):
        expected[:, j] += plain(since, knots, True, 0.0, duration[j], a[:, j]) * np.cos(phase[:, j])
        expected[:, j] += plain(since, knots, True, 0.0, duration[j], b[:, j]) * np.sin(phase[:, j])
    for row, (order, wave) in enumerate([(2, np.cos), (2, np.sin), (3, np.cos), (3, np.sin)]):
        expected += overtones[row] * wave(order * phase)
    found = Y.copy()
    add_wave(found, TIME, frequency, cosine, sine, overtones)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-11)


@pytest.mark.parametrize("own", [False, True])
def test_a_current_is_integrated_exactly_along_straight_lines(own):
    u = Y if own else Y[:, :1].copy()
    largest, currents, found = drawn(5.0, 20.0), RNG.normal(size=(ORDERS, SWARM)), Y.copy()
    nodes, shares = np.polynomial.legendre.leggauss(4)  # exact for powers up to 7
    z, expected = u / largest, Y.copy()
    for node, share in zip(0.5 * (1.0 + nodes), 0.5 * shares, strict=True):
        between = z[:-1] + node * np.diff(z, axis=0)
        current = sum(currents[k - 1] * between**k for k in range(1, ORDERS + 1))
        expected[1:] += np.cumsum(share * current * np.diff(TIME)[:, None], axis=0)
    collect(found, TIME, u, largest, currents)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_each_is_off_to_the_last_bit_at_its_null():
    zero, one, off = np.zeros(SWARM), np.ones(SWARM), np.zeros((ORDERS, SWARM))
    curves, _ = splines(KNOTS["even"], False, zero, one, size=0.0)
    found = Y.copy()
    add_spline(found, TIME, curves)
    scale_by_spline(found, TIME, curves)
    add_wave(found, TIME, one, curves, curves, off[:4])
    collect(found, TIME, Y, one, off)
    assert np.array_equal(found, Y)
    assert np.all(values_of(Y, curves) == 0.0)


def test_a_hum_at_the_phase_that_the_record_shows():
    duration, frequency, history = drawn(3.0, 4.5), drawn(5.0, 12.0), 60
    knots, since = tuple(k / 4.0 for k in range(5)), TIME - TIME[0]
    a = RNG.uniform(0.2, 0.8, (5, SWARM))
    phase = RNG.uniform(0.0, 2.0 * np.pi, SWARM)
    for j in range(SWARM):
        swell = plain(since, knots, True, 0.0, duration[j], a[:, j])
        hum = swell * np.cos(2.0 * np.pi * frequency[j] * TIME + phase[j])
        found = Y[:, j : j + 1].copy()
        one = natural_splines(np.zeros(1), duration[j : j + 1], knots=knots, ordinates=a[:, j : j + 1], held=True)
        add_at_own_phase(found, TIME, (Y[:, j] + hum + 5.0)[history:], frequency[j : j + 1], one)
        assert np.max(np.abs(found[:, 0] - Y[:, j] - hum)) < 0.1 * np.max(np.abs(hum))
    still, zero = Y.copy(), natural_splines(np.zeros(SWARM), duration, knots=knots, ordinates=0.0 * a, held=True)
    add_at_own_phase(still, TIME, Y[history:, 0] + 1.0, frequency, zero)
    assert np.array_equal(still, Y)

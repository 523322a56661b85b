"""The free-energy kernel against brute-force relays, a plain-Python twin and the true error function."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import erf

from hysteresis_bench.compose import System
from hysteresis_bench.kernels.free_energy import error_function, magnetization, quadrature
from hysteresis_bench.signals import Signal, read_only
from hysteresis_plugins.models.free_energy import FreeEnergy

FIELD = 4.0 * np.sin(np.linspace(0.0, 16.0 * np.pi, 600)) * np.linspace(1.0, 0.3, 600)
VALUES = {"M_R": 1.0, "eta": 40.0, "H_c": 1.0, "b": 0.6, "c": 0.25, "alpha": 1.3}


def simulated(model=None, field=FIELD, **changes):
    """(samples, swarm) of free-energy at VALUES, some of them changed, each to a number or a swarm of them."""
    columns = np.broadcast_arrays(*[np.atleast_1d(changes.get(name, value)) for name, value in VALUES.items()])
    signal = Signal(np.arange(field.size, dtype=float), field[:, None])
    return System(model or FreeEnergy()).simulate(signal, np.array(columns, dtype=float))


def relays(across, along, values=VALUES, field=FIELD):
    """Equations (1) to (3) taken literally: a grid of relays, `across` in H_c by `along` in H_I."""
    s = np.linspace(-4.0, 4.0, across)
    coercive = (values["H_c"] * np.exp(2 * values["c"] * (s + values["c"])))[:, None]
    # e^(-(ln(H_c / mean) / 2c)^2) dH_c
    density = np.exp(-((np.log(coercive / values["H_c"]) / (2 * values["c"])) ** 2)) * 2 * values["c"] * coercive
    density *= s[1] - s[0]
    interaction = (np.arange(along) + 0.5) / along * 10.0 * values["b"] - 5.0 * values["b"]
    weight = density * np.exp(-(interaction**2) / (2 * values["b"] ** 2)) * 10.0 * values["b"] / along
    up = np.broadcast_to(interaction > 0.0, weight.shape)  # demagnetized
    result = np.empty(field.size)
    for k, h in enumerate(field):
        effective = h + interaction
        up = np.where(effective >= coercive, True, np.where(effective <= -coercive, False, up))
        kernel = effective / values["eta"] + np.where(up, values["M_R"], -values["M_R"])
        result[k] = values["alpha"] * np.sum(weight * kernel)
    return result


def relative(difference):
    return np.sqrt(np.mean(difference**2)) / np.ptp(relays(50, 100))


def test_brute_force_relays_converge_to_the_model():
    exact = simulated(FreeEnergy(nodes=1024, span=4.0))[:, 0]
    errors = [relative(relays(n, 2 * n) - exact) for n in (50, 100, 200)]
    assert errors[2] < 1e-3
    assert errors[0] > errors[1] > errors[2]


def test_default_quadrature_is_good_to_a_thousandth():
    exact = simulated(FreeEnergy(nodes=2048, span=4.5))
    assert relative(simulated() - exact) < 1e-3


@pytest.mark.parametrize("rule", ["trapezoid", "gauss-legendre", "gauss-hermite"])
def test_rules_converge_to_each_other(rule):
    exact = simulated(FreeEnergy(nodes=2048, span=4.5))
    errors = [relative(simulated(FreeEnergy(rule, nodes, 4.0)) - exact) for nodes in (16, 128)]
    assert errors[1] < errors[0] < 0.02
    assert errors[1] < 3e-3


@pytest.mark.parametrize("rule", ["trapezoid", "gauss-legendre", "gauss-hermite"])
def test_quadrature_integrates_the_density(rule):
    offsets, weights = quadrature(rule, 40, 4.0)
    assert np.all(np.diff(offsets) > 0.0)
    np.testing.assert_allclose([weights.sum(), weights @ offsets, weights @ offsets**2], [1.0, 0.0, 0.5], atol=1e-5)


def test_error_function_against_scipy():
    x = np.concatenate([np.linspace(-6.0, 6.0, 20001), [-1e300, -np.inf, 0.0, np.inf]])
    ours = np.array([error_function(value) for value in x])
    assert np.max(np.abs(ours - erf(x))) < 3e-9


def test_compiled_equals_a_plain_twin():
    offsets, weights = quadrature("trapezoid", 13, 3.0)
    rng = np.random.default_rng(0)
    slope, amplitude, coercive, spread, width = rng.uniform(0.2, 1.0, (5, 6))
    field = rng.normal(0.0, 2.0, (80, 6))
    expected = np.empty_like(field)
    for i in range(6):
        plays = np.zeros(13)
        radius = coercive[i] * np.exp(2 * spread[i] * (spread[i] + offsets))
        for k in range(80):
            plays = np.maximum(field[k, i] - radius, np.minimum(field[k, i] + radius, plays))
            expected[k, i] = slope[i] * field[k, i] + amplitude[i] * (weights @ erf(plays / (width[i] * math.sqrt(2))))
    found = magnetization(read_only(field), slope, amplitude, coercive, spread, width, offsets, weights)
    np.testing.assert_allclose(found, expected, atol=1e-8)


def test_a_column_does_not_depend_on_its_swarm():
    widths = np.array([0.3, 0.6, 0.9, 1.2, 1.5])
    swarm = simulated(b=widths)
    for i, width in enumerate(widths):
        assert np.array_equal(swarm[:, i], simulated(b=width)[:, 0])


def test_saturation_and_symmetry():
    high = simulated(field=np.array([0.0, 1e6, -1e6]), eta=1e15)[:, 0]
    mass = VALUES["alpha"] * math.sqrt(2 * math.pi) * 0.6 * 2 * math.sqrt(math.pi) * 0.25 * math.exp(0.25**2)
    np.testing.assert_allclose(high, [0.0, mass, -mass], rtol=1e-6)
    np.testing.assert_array_equal(simulated(field=-FIELD), -simulated())


def test_rate_independent_and_finite_in_the_corners_of_the_box():
    box = FreeEnergy.parameters
    corners = np.array(np.meshgrid(*[[q.lower, q.upper] for q in box])).reshape(len(box), -1)
    signal = Signal(np.arange(FIELD.size, dtype=float), FIELD[:, None])
    found = System(FreeEnergy()).simulate(signal, corners)
    assert np.all(np.isfinite(found))
    # a sample repeated changes nothing: only the order of samples matters
    held = np.repeat(FIELD, 2)
    np.testing.assert_array_equal(simulated(field=held)[::2], simulated())


@pytest.mark.parametrize("name", ["H_c", "b", "c", "eta"])
def test_widths_must_be_positive(name):
    with pytest.raises(ValueError, match=f"{name} must be above 0"):
        simulated(**{name: np.array([0.5, 0.0])})

"""The energy-based kernel against a plain solution of its equations by bracketing."""

import numpy as np
import pytest
from scipy.optimize import brentq

from hysteresis_bench.kernels.energy_based import energy_based

PATH = 3.0 * np.cumsum(np.random.default_rng(3).normal(size=150)) / 4.0
PINNING, SHARES = [0.0, 0.4, 1.1], [0.3, 0.5, 0.2]


def langevin(x):
    return 1.0 / np.tanh(x) - 1.0 / x if abs(x) > 1e-3 else x / 3.0


@pytest.mark.parametrize("coupling", [0.0, 0.6, 0.95])
def test_it_is_its_equations(coupling):
    a = 0.7
    places, expected = [0.0] * 3, []
    for i, field in enumerate(PATH.tolist()):
        widths = PINNING if i else [0.0] * 3

        def moved(m, field=field, widths=widths, places=tuple(places)):
            h = field + 3.0 * a * coupling * m
            return [max(h - k, min(h + k, p)) for k, p in zip(widths, places, strict=True)]

        def excess(m, moved=moved):
            return sum(s * langevin(p / a) for s, p in zip(SHARES, moved(m), strict=True)) - m

        m = brentq(excess, -1.0, 1.0, xtol=1e-14)
        places = moved(m)
        expected.append(m)
    found = energy_based(
        PATH[:, None], np.array([a]), np.array([coupling]), np.array(PINNING)[:, None], np.array(SHARES)[:, None]
    )
    np.testing.assert_allclose(found[:, 0], expected, atol=2e-7)  # the Langevin kernel has 7e-10 relative


def test_without_pinning_there_is_no_loop():
    u = 5.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 401))
    one = np.ones(1)
    m = energy_based(u[:, None], one, 0.9 * one, np.zeros((1, 1)), np.ones((1, 1)))[:, 0]
    np.testing.assert_allclose(m[:201], m[200:], atol=1e-9)
    rising, falling = m[:51], m[50:101]
    np.testing.assert_allclose(rising, falling[::-1], atol=1e-9)


def test_a_closed_loop_dissipates():
    u = 5.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 801))
    one = np.ones(1)
    m = energy_based(u[:, None], one, 0.5 * one, np.array([[0.8]]), np.ones((1, 1)))[400:, 0]
    u = u[400:]
    lost = np.sum(0.5 * (u[1:] + u[:-1]) * np.diff(m))
    assert lost > 0.0
    # the plays lose the pinning times their path, which for one cell is the change of m: |dm| 0.8
    assert lost == pytest.approx(0.8 * np.sum(np.abs(np.diff(m))), rel=1e-2)

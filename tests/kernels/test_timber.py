"""The kernel of timber joints against a plain twin, and against what its source says of its paths."""

from itertools import pairwise

import numpy as np

from hysteresis_bench.kernels.timber import timber

PATH = np.interp(np.arange(0.0, 9.0, 0.03), np.arange(9), [0.0, 1.2, -0.8, 2.0, -2.0, 0.5, -1.0, 3.0, -3.0])
JOINT = np.array([0.3, 0.05, 1.5, 0.1, 0.2, 0.7, 1.1])[:, None]


def plain(u, u_y, r_1, r_3, f_I, r_4, alpha, beta):
    """Half cycle by half cycle."""

    def envelope(x):
        return (1.0 + r_1 * x) * (1.0 - np.exp(-x))

    x = (u - u[0]) / u_y
    f, way, furthest = 0.0, 0, {1: 0.0, -1: 0.0}
    found = [0.0]
    for old, new in pairwise(x):
        s = 1 if new > old else -1
        if way == -s:
            furthest[way] = max(furthest[way], way * old)
        way = s
        end, top = beta * furthest[s], max(furthest.values())
        K, soft = (max(X, 1.0) ** -alpha for X in (furthest[s], top))
        if s * new >= end:
            bound = envelope(s * new)
        else:
            back = min(envelope(end) + K * (s * new - end), envelope(max(s * new, 0.0)))
            bound = max(f_I + r_4 * soft * s * new, back)
        f = s * min(s * f + r_3 * abs(new - old), max(bound, s * f))
        found.append(f)
    return np.array(found)


def test_it_is_its_twin():
    rng = np.random.default_rng(0)
    spread = JOINT * np.exp(rng.normal(0.0, 0.3, (7, 20)))
    spread[6] = np.maximum(spread[6], 1.0)
    found = timber(PATH[:, None], spread)
    for j in range(20):
        np.testing.assert_allclose(found[:, j], plain(PATH, *spread[:, j]), atol=1e-12)
    assert np.array_equal(timber(np.repeat(PATH[:, None], 20, axis=1), spread), found)


def test_it_first_follows_the_envelope():
    u = np.linspace(0.0, 2.0, 50)
    x = u / 0.3
    np.testing.assert_allclose(timber(u[:, None], JOINT)[:, 0], (1.0 + 0.05 * x) * (1.0 - np.exp(-x)), atol=1e-12)


def test_a_second_cycle_of_the_same_amplitude_is_weaker_until_it_goes_further():
    u = np.interp(np.arange(0.0, 5.0, 0.01), [0, 1, 2, 3, 4, 5], [0.0, 1.0, -1.0, 1.0, -1.0, 1.5])
    f = timber(u[:, None], JOINT)[:, 0]
    assert f[300] < 0.95 * f[100]
    x = 1.5 / 0.3
    last = timber(np.append(u, 1.5)[:, None], JOINT)[-1, 0]
    np.testing.assert_allclose(last, (1.0 + 0.05 * x) * (1.0 - np.exp(-x)), rtol=1e-2)


def test_no_force_changes_faster_than_by_unloading():
    f = timber(PATH[:, None], JOINT)[:, 0]
    assert np.all(np.abs(np.diff(f)) <= 1.5 * np.abs(np.diff(PATH)) / 0.3 + 1e-12)

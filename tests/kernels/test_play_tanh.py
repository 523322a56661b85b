"""Populations of hyperbolic tangents of plays against a plain loop."""

import math

import numpy as np

from hysteresis_bench.kernels.play_tanh import play_tanh


def test_it_is_the_sum_of_tangents_of_plain_plays():
    rng = np.random.default_rng(6)
    u = np.cumsum(rng.normal(size=250))
    heights, centres = rng.normal(size=(2, 4)), rng.normal(size=(2, 4))
    radii, widths = rng.uniform(0.0, 3.0, (2, 4)), rng.uniform(0.01, 2.0, (2, 4))
    found = play_tanh(u[:, None], heights, radii, centres, widths)
    for j in range(4):
        places, expected = [u[0]] * 2, []
        for value in u.tolist():
            places = [max(value - r, min(value + r, p)) for r, p in zip(radii[:, j], places, strict=True)]
            expected.append(
                sum(heights[k, j] * math.tanh((places[k] - centres[k, j]) / widths[k, j]) for k in range(2))
            )
        np.testing.assert_allclose(found[:, j], expected, rtol=0, atol=1e-12)


def test_a_saturated_loop_is_the_branches_of_miller():
    u = np.concatenate([np.linspace(0, 9, 200), np.linspace(9, -9, 400), np.linspace(-9, 9, 400)])
    one = np.ones((1, 1))
    y = play_tanh(u[:, None], 2.0 * one, 1.5 * one, 0.0 * one, 0.8 * one)[:, 0]
    rising = slice(700, 1000)
    np.testing.assert_allclose(y[rising], 2.0 * np.tanh((u[rising] - 1.5) / 0.8), rtol=1e-12)

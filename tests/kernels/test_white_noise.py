"""White noise by differences: its size on a smooth signal with corners, whatever the order."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.kernels.white_noise import white_noise_rms


@pytest.mark.parametrize("order", [1, 2, 4])
def test_the_size_of_the_noise_is_found_on_a_triangle(order):
    rng = np.random.default_rng(4)
    triangle = np.abs(np.linspace(-3.0, 3.0, 20_000) % 2.0 - 1.0)
    assert white_noise_rms(triangle + rng.normal(0.0, 0.1, triangle.size), order) == pytest.approx(0.1, rel=0.03)


def test_a_polynomial_and_too_few_samples_have_none():
    assert white_noise_rms(np.arange(50.0) ** 2, 4) == 0.0
    assert white_noise_rms(np.arange(4.0) ** 3, 4) == 0.0

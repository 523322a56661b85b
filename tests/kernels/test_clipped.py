import numpy as np
import pytest

from hysteresis_bench.kernels.clipped import clipped_rms

SHRINK = 0.9866


def plain(sizes, rms):
    for _ in range(20):
        inside = sizes[sizes <= 3.0 * rms]
        new = np.sqrt(np.mean(inside**2)) / SHRINK if inside.size else 0.0
        if abs(new - rms) <= 1e-4 * rms:
            return new, inside.size
        rms = new
    return rms, inside.size


@pytest.mark.parametrize("outliers", [0, 30, 900])
def test_it_equals_the_plain_loop(outliers):
    rng = np.random.default_rng(outliers)
    sizes = np.abs(np.concatenate([rng.standard_normal(1000), 50.0 * rng.standard_normal(outliers)]))
    found, kept = clipped_rms(sizes, float(np.median(sizes)) / 0.6745, 3.0, SHRINK)
    assert (found, kept) == (pytest.approx(plain(sizes, float(np.median(sizes)) / 0.6745)[0], rel=1e-13), kept)
    assert kept == plain(sizes, float(np.median(sizes)) / 0.6745)[1]


def test_nothing_inside_is_no_noise():
    assert clipped_rms(np.full(5, 2.0), 0.1, 3.0, SHRINK) == (0.0, 0)
    assert clipped_rms(np.zeros(5), 0.0, 3.0, SHRINK) == (0.0, 5)

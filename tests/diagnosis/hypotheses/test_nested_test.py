"""The nested-model test holds its level where residuals are correlated, and sees what is there."""

import numpy as np
import pytest
from scipy.signal import lfilter

from hysteresis_bench.diagnosis.hypotheses.nested_test import SEARCHED, nested_test


def fits(rng, memory, signal=0.0, size=1500):
    """Residuals of a constant, and of a constant with one searched sinusoid, on two records."""
    noise = [lfilter([1.0], [1.0, -memory], rng.standard_normal(size)) for _ in range(2)]
    phase = np.linspace(0.0, 1.0, size)
    wave = np.cos(2 * np.pi * 3.2 * phase)
    before = [part - part.mean() + signal * np.std(part) * wave for part in noise]
    frequencies = np.linspace(1.0, 6.0, 26)
    columns = [np.column_stack([np.cos(2 * np.pi * f * phase), np.sin(2 * np.pi * f * phase)]) for f in frequencies]

    def left(column):
        design, joined = np.vstack([column, column]), np.concatenate(before)
        return joined - design @ np.linalg.lstsq(design, joined, rcond=None)[0]

    best = min((left(column) for column in columns), key=lambda e: float(e @ e))
    return before, np.split(best, 2)


@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_level_with_a_searched_parameter(memory):
    rng = np.random.default_rng(5)
    p = [nested_test(*fits(rng, memory), added=3 + SEARCHED, free=4).p for _ in range(60)]
    assert np.mean(np.array(p) < 0.01) <= 0.05


def test_power():
    rng = np.random.default_rng(6)
    p = [nested_test(*fits(rng, 0.5, signal=0.5), added=3 + SEARCHED, free=4).p for _ in range(10)]
    assert max(p) < 1e-4


def test_no_gain_is_no_evidence():
    residuals = [np.random.default_rng(7).standard_normal(100)]
    assert nested_test(residuals, residuals, 3, 5).p == 1.0

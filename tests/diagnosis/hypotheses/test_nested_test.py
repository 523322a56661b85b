"""The nested-model test holds its level where residuals are correlated, and sees what is there."""

import numpy as np
import pytest
from scipy.signal import lfilter

from hysteresis_bench.diagnosis.hypotheses.nested_test import SEARCHED, NestedTest, nested_test


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


def test_blocks_left_out_may_speak_of_what_is_slow_beside_a_residual_that_is_fast():
    """A drift of more than what another effect leaves, and a little more left of what is fast."""
    fast = lfilter([1.0], [1.0, -0.95], np.random.default_rng(8).standard_normal(2000))
    before, after = [fast + 2.2 * np.std(fast) * np.linspace(-1.0, 1.0, 2000)], [1.05 * fast]
    found = nested_test(before, after, 3, 8)
    assert np.mean(before[0] ** 2) > 2.0 * np.mean(after[0] ** 2)
    assert found.p == 1.0
    assert found.either(1e-9).p < 1e-8
    assert found.either(0.2).p > 0.3


def test_both_are_paid_for():
    assert NestedTest(9.0, 1e-3, 3).either(0.5).p == pytest.approx(2e-3)
    assert NestedTest(9.0, 0.9, 3).either(1.0).p == 1.0

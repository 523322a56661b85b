"""Equal optimizers are seldom called different, whatever their results look like: a smaller benchmarks/error_rates."""

import itertools

import numpy as np
import pytest
from scipy.stats import rankdata, wilcoxon

from benchmarks.error_rates import KINDS, share_of_families, share_told_apart
from hysteresis_bench import statistics

STUDIES = 100
MOST = 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / STUDIES)
"""What the level and three standard errors allow."""
EQUAL = [name for name in KINDS if name != "same median, other shape"]


@pytest.mark.parametrize("kind", EQUAL)
def test_equal_optimizers_are_seldom_called_different(kind):
    assert share_told_apart(KINDS[kind], studies=STUDIES) <= MOST


def test_any_of_ten_equal_ones_is_seldom_told_apart_after_holm():
    assert share_of_families(10, studies=STUDIES) <= MOST


def test_all_signs_are_counted_one_by_one():
    values = np.array([0.3, -0.1, 0.0, 0.1, 0.7, -0.2, 0.2, 0.2])
    ranks = rankdata(np.abs(values)) * (values != 0.0)
    sums = np.array([np.dot(ranks, signs) for signs in itertools.product((0, 1), repeat=values.size)])
    seen = ranks[values > 0].sum()
    wanted = min(1.0, 2.0 * min(np.mean(sums <= seen + 1e-9), np.mean(sums >= seen - 1e-9)))
    assert statistics.wilcoxon(values, np.zeros(8)) == pytest.approx(wanted)


def test_four_differences_of_twenty_are_never_enough():
    """All four to one side happens by chance in an eighth of the studies; a normal distribution takes it for 4.6 %."""
    values = np.zeros(20)
    values[:4] = [0.5, 0.7, 0.9, 1.1]
    assert statistics.wilcoxon(values, np.zeros(20)) == pytest.approx(0.125)
    assert wilcoxon(values, zero_method="pratt", method="asymptotic").pvalue < statistics.LEVEL


@pytest.mark.parametrize("blocks", [20, 250])
def test_without_ties_it_is_scipys(blocks):
    values = np.random.default_rng(5).normal(0.2, 1.0, blocks)
    assert statistics.wilcoxon(values, np.zeros(blocks)) == pytest.approx(wilcoxon(values).pvalue)

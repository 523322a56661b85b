"""Equal optimizers are seldom called different, whatever their results look like: a smaller benchmarks/error_rates."""

import itertools

import numpy as np
import pytest
from scipy.stats import rankdata

from benchmarks.error_rates import KINDS, by_signs, p_by_signs, share_of_families, share_told_apart
from hysteresis_bench import statistics

STUDIES = 200
MOST = 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / STUDIES)
"""What the level and three standard errors allow."""
EQUAL = [name for name in KINDS if name != "same median, other shape"]


@pytest.mark.parametrize("kind", EQUAL)
def test_equal_optimizers_are_seldom_called_different(kind):
    assert share_told_apart(KINDS[kind], studies=STUDIES) <= MOST


@pytest.mark.parametrize("kind", ["heavy tails", "on a coarse grid", "the one spreads 10 times"])
def test_so_says_the_test_by_all_signs(kind):
    assert by_signs(KINDS[kind], studies=STUDIES) <= MOST


def test_any_of_ten_equal_ones_is_seldom_told_apart_after_holm():
    assert share_of_families(10, studies=STUDIES) <= MOST


def test_all_signs_are_counted_one_by_one():
    values = np.array([0.3, -0.1, 0.0, 0.1, 0.7, -0.2, 0.2, 0.2])
    ranks = rankdata(np.abs(values)) * (values != 0.0)
    sums = np.array([np.dot(ranks, signs) for signs in itertools.product((0, 1), repeat=values.size)])
    seen = ranks[values > 0].sum()
    wanted = min(1.0, 2.0 * min(np.mean(sums <= seen + 1e-9), np.mean(sums >= seen - 1e-9)))
    assert p_by_signs(values) == pytest.approx(wanted)
    assert p_by_signs(np.zeros(5)) == 1.0


@pytest.mark.parametrize("ties", [False, True])
def test_near_the_level_the_p_of_twenty_instances_is_that_of_all_signs(ties):
    rng, near = np.random.default_rng(5), 0
    for _ in range(100):
        values = rng.normal(0.5, 1.0, 20)
        values = np.round(values) if ties else values
        if (wanted := p_by_signs(values)) < 0.1:
            near += 1
            assert statistics.wilcoxon(values, np.zeros(20)) == pytest.approx(wanted, abs=0.02)
    assert near > 20

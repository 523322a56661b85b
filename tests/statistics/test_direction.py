"""The test tells which one it favours; where A12 does not, there is no verdict."""

import numpy as np
import pytest

from hysteresis_bench import statistics
from hysteresis_bench.statistics.ranks import COUNTED_EXACTLY


def sample(values):
    """One trial an instance."""
    return statistics.Sample(tuple(np.array([value]) for value in values))


SMALL_WINS_LARGE_LOSSES = np.concatenate([-0.02 - 0.001 * np.arange(21), 1.0 + 0.1 * np.arange(19)])
"""Ours less theirs on 40 instances."""


def test_many_small_wins_against_large_losses_are_no_better():
    theirs = 10.0 * np.arange(40.0)
    ours, other = sample(theirs + SMALL_WINS_LARGE_LOSSES), sample(theirs)
    [found] = statistics.compare([ours], other)
    assert found.p == pytest.approx(0.015, abs=0.001)
    assert found.a12 == 21 / 40
    assert found.favours == -1
    assert (found.verdict, found.words) == (statistics.CANNOT_TELL, statistics.AT_ODDS)
    [mirrored] = statistics.compare([other], ours)
    assert (mirrored.favours, mirrored.verdict) == (1, statistics.CANNOT_TELL)


@pytest.mark.parametrize("blocks", [20, COUNTED_EXACTLY + 50])
def test_the_test_favours_the_lower_one_by_ranks(blocks):
    lower = np.arange(blocks) + 0.5 * np.sin(np.arange(blocks))
    higher = np.arange(blocks) + 1.0
    found = statistics.signed_rank(lower, higher)
    assert found.favours == 1
    assert found.mirrored == statistics.signed_rank(higher, lower)
    assert found.p == statistics.wilcoxon(lower, higher) < 0.01
    assert statistics.signed_rank(lower, lower).favours == 0


def test_every_pair_is_corrected_over_all_of_them():
    rng = np.random.default_rng(2)
    samples = {
        name: statistics.Sample((rng.normal(shift, 1.0, 30),))
        for name, shift in zip("abcd", (0, 0.3, 0.6, 0.9), strict=True)
    }
    found = statistics.every_pair(samples)
    pairs = [("a", "b"), ("a", "c"), ("a", "d"), ("b", "c"), ("b", "d"), ("c", "d")]
    alone = [statistics.signed_rank(samples[one].blocks, samples[other].blocks) for one, other in pairs]
    assert [found[pair].p for pair in pairs] == pytest.approx(statistics.holm([test.p for test in alone]))
    assert [found[pair].favours for pair in pairs] == [test.favours for test in alone]
    assert all(found[one, other] == found[other, one].mirrored for one, other in pairs)

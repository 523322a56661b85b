"""Instances as blocks: equivalence, intervals, and how often equal optimizers are called different."""

import itertools

import numpy as np
import pytest

from benchmarks.verdicts import study, verdicts
from hysteresis_bench import statistics
from hysteresis_bench.statistics.equivalence import DRAWS, PRIOR, _weights, practical
from hysteresis_bench.statistics.ranks import differences

RNG = np.random.default_rng(1)


def test_the_bayesian_signed_rank_test_is_the_papers_formula():
    """A plain twin, one draw and one Walsh average at a time."""
    z, region, rng = RNG.normal(0.005, 0.02, 6), 0.01, np.random.default_rng(2)
    values, wins = [0.0, *z], np.zeros(3)
    for weights in rng.dirichlet([PRIOR, *[1.0] * 6], 4000):
        shares = np.zeros(3)
        for (i, one), (j, other) in itertools.product(enumerate(values), repeat=2):
            side = 0 if one + other < -2 * region else 2 if one + other > 2 * region else 1
            shares[side] += weights[i] * weights[j]
        wins[np.argmax(shares)] += 1
    found = practical(z, np.zeros(6), region)
    assert (found.better, found.equivalent, found.worse) == pytest.approx(tuple(wins / 4000), abs=0.03)


@pytest.mark.parametrize(("shift", "verdict"), [(0.0, "equivalent"), (-0.05, "better"), (0.05, "worse")])
def test_verdicts_follow_the_size_of_the_difference(shift, verdict):
    theirs = RNG.normal(0.0, 1.0, 20)
    ours = theirs + shift + RNG.normal(0.0, 0.002, 20)
    samples = [statistics.Sample(tuple(np.array([value]) for value in side)) for side in (ours, theirs)]
    [found] = statistics.compare(samples[:1], samples[1])
    assert found.verdict == verdict


def test_noise_larger_than_the_difference_cannot_be_told():
    samples = study(np.random.default_rng(4), instances=20, trials=2, shift=0.02, spread=0.5)
    [found] = statistics.compare_pairs([samples])
    assert found.verdict == "cannot tell"


def test_rounding_is_a_tie():
    theirs = RNG.normal(0.0, 1.0, 20)
    one, other = (statistics.Sample((side,)) for side in (theirs - 1e-7, theirs))
    [found] = statistics.compare([one], other)
    assert (found.p, found.a12, found.verdict) == (1.0, pytest.approx(0.5), "equivalent")


def test_a12_does_not_mix_instances():
    """Better by a little in every instance, which differ by much."""
    levels = np.arange(15.0)
    ours = tuple(np.array([level, level]) for level in levels)
    theirs = tuple(np.array([level + 0.1, level + 0.2]) for level in levels)
    assert statistics.mean_a12(ours, theirs) == 1.0
    assert statistics.a12(np.concatenate(ours), np.concatenate(theirs)) < 0.6


def scores(ours, theirs, tie):
    """Every pair by itself: 1 where ours is the lower one, 1/2 where they are equal, or within the tie."""
    x, y = ours[:, None], theirs[None, :]
    with np.errstate(invalid="ignore"):
        even = (x == y) | (np.abs(x - y) <= tie)
    return np.where(even, 0.5, x < y)


@pytest.mark.parametrize("tie", [0.0, 1e-6, 0.1, 0.3])
def test_pairs_counted_by_order_are_those_counted_one_by_one(tie):
    for sizes in [(30, 40), (1, 7), (7, 1), (200, 200)]:
        ours, theirs = (RNG.integers(-5, 6, size) / 10 + 1e-6 * RNG.integers(-2, 3, size) for size in sizes)
        ours[: sizes[0] // 5], theirs[: sizes[1] // 7] = np.inf, np.inf
        assert statistics.a12(ours, theirs, tie) == scores(ours, theirs, tie).mean()


@pytest.mark.parametrize("shift", [0.0, 0.004, 0.02, -0.03, 0.5])
@pytest.mark.parametrize("spread", [0.0, 0.001, 0.02])
def test_the_favoured_regions_are_those_of_all_sums(shift, spread):
    """Most draws are told by what lies in a single region; here from every pair."""
    ours, theirs, region = RNG.normal(0.0, 0.1, 40), RNG.normal(0.0, spread, 40), 0.01
    theirs += ours - shift
    ours[:3], theirs[2:4] = np.inf, np.inf
    z = np.concatenate([[0.0], differences(ours, theirs)])
    sums, weights = z[:, None] + z[None, :], _weights(z.size)
    inside = [sums < -2 * region, np.abs(sums) <= 2 * region, sums > 2 * region]
    shares = [np.einsum("di,di->d", weights @ pairs, weights) for pairs in inside]
    favoured = np.bincount(np.argmax(shares, axis=0), minlength=3) / DRAWS
    found = practical(ours, theirs, region)
    assert (found.better, found.equivalent, found.worse) == tuple(favoured)


def test_intervals_cover_and_know_failures():
    covered = 0
    for _ in range(200):
        low, high = statistics.median_interval(RNG.normal(0.0, 1.0, 25))
        covered += low <= 0.0 <= high
    assert 0.9 <= covered / 200 <= 1.0
    assert statistics.median_interval([1.0, np.inf, np.inf]) == (1.0, np.inf)
    assert statistics.median_interval([]) == (np.inf, np.inf)
    assert statistics.running_time_interval([100.0] * 10, [1.0] * 10) == (100.0, 100.0)
    assert statistics.running_time_interval([100.0] * 10, [0.0] * 10) == (np.inf, np.inf)


def test_two_equal_optimizers_are_seldom_called_different():
    """A smaller version of benchmarks/verdicts.py; at most what the level and three standard errors allow."""
    found = verdicts(studies=200, shift=0.0, spread=0.05)
    assert found["better"] + found["worse"] <= 0.05 + 3 * np.sqrt(0.05 * 0.95 / 200)


def test_a_difference_of_a_tenth_is_found():
    found = verdicts(studies=60, shift=0.1, spread=0.05)
    assert found["worse"] >= 0.95

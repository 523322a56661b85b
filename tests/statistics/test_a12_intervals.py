"""The interval of A12: it knows where A12 ends, and holds the truth as often as it says, near 0 and 1 too."""

import numpy as np
import pytest
from scipy.stats import beta, norm

from hysteresis_bench import statistics

STUDIES = 200
LEAST = 0.95 - 3.0 * np.sqrt(0.05 * 0.95 / STUDIES)
"""Of intervals that hold the truth: the level less three standard errors of a share of so many studies."""
TRUTHS = (0.5, 0.7, 0.9, 0.99)


def alike(rng, truth, size):
    """Both lognormal of the same spread."""
    return rng.normal(0.0, 1.0, size), rng.normal(np.sqrt(2.0) * norm.ppf(truth), 1.0, size)


def unlike(rng, truth, size):
    """The other one spreads ten times as much."""
    return rng.normal(0.0, 1.0, size), rng.normal(np.sqrt(101.0) * norm.ppf(truth), 10.0, size)


def against_one_value(rng, truth, size):
    """The other one is deterministic."""
    return rng.normal(0.0, 1.0, size), np.full(size, norm.ppf(truth))


def two_optima(rng, truth, size):
    """Most trials tie in the good optimum or the bad one."""
    return (rng.random(size) < 1.0 - truth).astype(float), (rng.random(size) < truth).astype(float)


def always_at_the_best(rng, truth, size):
    """Ours always finds the best, the other one at times: nothing but wins and ties."""
    return np.zeros(size), (rng.random(size) < 2.0 * truth - 1.0).astype(float)


KINDS = (alike, unlike, against_one_value, two_optima, always_at_the_best)


def covered(truth, intervals):
    return np.mean([low - 1e-12 <= truth <= high + 1e-12 for _, low, high in intervals])


@pytest.mark.parametrize("truth", TRUTHS)
@pytest.mark.parametrize("kind", KINDS)
def test_over_trials_of_one_instance_it_holds_the_truth(kind, truth):
    rng = np.random.default_rng(1)
    drawn = [kind(rng, truth, statistics.ENOUGH) for _ in range(STUDIES)]
    assert covered(truth, [statistics.a12_interval([ours], [theirs]) for ours, theirs in drawn]) >= LEAST


def the_same(rng, truth, instances):
    return np.full(instances, truth)


def all_or_nothing(rng, truth, instances):
    """The one is better in any trial on some instances, the other one on the others."""
    return (rng.random(instances) < truth).astype(float)


def won_or_even(rng, truth, instances):
    return np.where(rng.random(instances) < 2.0 * (1.0 - truth), 0.5, 1.0)


@pytest.mark.parametrize("truth", TRUTHS)
@pytest.mark.parametrize("of_instances", [the_same, all_or_nothing, won_or_even])
def test_over_instances_it_holds_the_truth(of_instances, truth):
    rng = np.random.default_rng(2)
    found = []
    for _ in range(STUDIES):
        each = np.clip(of_instances(rng, truth, statistics.ENOUGH), 1e-12, 1.0 - 1e-12)
        difficulty = rng.normal(0.0, 100.0, each.size)
        pairs = [[level + side for side in alike(rng, share, 2)] for level, share in zip(difficulty, each, strict=True)]
        found.append(statistics.a12_interval(*zip(*pairs, strict=True)))
    assert covered(truth, found) >= LEAST


@pytest.mark.parametrize("blocks", [14, 30])
def test_where_one_side_always_wins_it_is_that_of_as_many_wins(blocks):
    """Clopper and Pearson (1934): of n successes in n trials the lower end is 0.025^(1/n)."""
    ours, theirs = np.arange(blocks, dtype=float), np.arange(blocks) + 100.0
    instances = [[np.array([value, value]) for value in side] for side in (ours, theirs)]
    for found in (statistics.a12_interval([ours], [theirs]), statistics.a12_interval(*instances)):
        assert found == pytest.approx((1.0, 0.025 ** (1 / blocks), 1.0))
    assert statistics.a12_interval([theirs], [ours]) == pytest.approx((0.0, 0.0, 1.0 - 0.025 ** (1 / blocks)))


def test_against_one_value_trials_are_yes_or_no():
    """Nothing but the trials of the one side varies."""
    ours = np.array([-1.0] * 16 + [1.0] * 4)
    ends = beta.ppf(0.025, 16, 5), beta.ppf(0.975, 17, 4)
    middle, low, high = statistics.a12_interval([ours], [np.zeros(20)])
    assert (middle, low, high) == pytest.approx((0.8, *ends), abs=0.02)
    assert low >= ends[0] - 1e-12


def test_instances_that_are_alike_are_worth_more():
    theirs = [np.arange(6.0)] * 20
    alike_ = [np.arange(6.0) - 1.5] * 20
    unlike_ = [np.arange(6.0) + (100.0 if i % 4 == 0 else -100.0) for i in range(20)]
    spans = [high - low for _, low, high in (statistics.a12_interval(ours, theirs) for ours in (alike_, unlike_))]
    assert spans[0] < 0.5 * spans[1]


def test_a_sample_without_trials_tells_nothing():
    assert statistics.a12_interval([np.array([])], [np.array([])]) == (0.5, 0.0, 1.0)


def test_clopper_and_pearson_have_the_published_interval():
    assert statistics.clopper_pearson(81, 263) == pytest.approx((0.2527, 0.3676), abs=5e-5)  # Newcombe 1998, table I
    assert statistics.clopper_pearson(0, 20) == pytest.approx((0.0, 0.1684), abs=5e-5)  # the same
    assert statistics.clopper_pearson(0, 0) == (0.0, 1.0)

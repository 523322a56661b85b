"""Statistics against scikit-posthocs, published worked values and what must hold for any sample."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import friedmanchisquare

from hysteresis_bench import statistics

INF = float("inf")


def compared(ours, theirs):
    """Two samples of one instance."""
    one, other = (statistics.Sample((np.asarray(side, dtype=float),)) for side in (ours, theirs))
    return statistics.compare([one], other)


values = st.lists(st.one_of(st.floats(0, 1e6), st.just(INF)), min_size=14, max_size=30)


def test_holm_is_the_textbook_example():
    # Holm: sorted 0.01, 0.03, 0.04 times 3, 2, 1, made monotonic
    assert statistics.holm([0.03, 0.01, 0.04]) == pytest.approx([0.06, 0.03, 0.06])


def test_wilcoxon_and_holm_agree_with_scikit_posthocs():
    posthocs = pytest.importorskip("scikit_posthocs")
    rng = np.random.default_rng(3)
    samples = [rng.normal(shift, 1.0, 20) for shift in (0.0, 0.4, 0.9, 1.5)]
    table = posthocs.posthoc_wilcoxon(samples)
    ours = [statistics.wilcoxon(sample, samples[0]) for sample in samples[1:]]
    assert ours == pytest.approx([table.iloc[row, 0] for row in (1, 2, 3)])
    from statsmodels.stats.multitest import multipletests  # comes with scikit-posthocs

    assert statistics.holm(ours) == pytest.approx(multipletests(ours, method="holm")[1])


def test_friedman_agrees_with_scipy_and_ranks_the_best_first():
    rng = np.random.default_rng(4)
    samples = [rng.normal(shift, 0.5, 30) for shift in (1.0, 0.0, 2.0)]
    ours = statistics.friedman(samples)
    assert (ours.statistic, ours.p) == pytest.approx(tuple(friedmanchisquare(*samples)))
    assert int(np.argmin(ours.mean_ranks)) == 1


def test_a12_counts_pairs_and_ties():
    assert statistics.a12([1, 2], [2, 3]) == (3 + 0.5) / 4
    assert statistics.a12([1, 1], [INF, INF]) == 1.0
    assert statistics.a12([INF], [INF]) == 0.5


def test_magnitude_follows_vargha_and_delaney():
    words = [statistics.magnitude(a) for a in (0.5, 0.56, 0.36, 0.71, 0.0)]
    assert words == ["negligible", "small", "medium", "large", "large"]


def test_too_few_trials_give_no_p():
    [few] = compared(np.arange(13.0), np.arange(13.0) + 5)
    assert few.p is None
    assert few.words == "too few trials to tell"
    [enough] = compared(np.arange(14.0), np.arange(14.0) + 5)
    assert enough.significant
    assert enough.words.startswith("better")
    assert statistics.friedman([np.arange(13.0)] * 3).p is None


def test_identical_samples_cannot_be_told_apart():
    [same] = compared(np.ones(20), np.ones(20))
    assert (same.p, same.a12, same.verdict) == (1.0, 0.5, "equivalent")
    assert statistics.friedman([np.ones(20)] * 4).p == 1.0


def test_failures_rank_worst():
    ours, theirs = np.linspace(1, 2, 20), np.full(20, INF)
    [comparison] = compared(ours, theirs)
    assert comparison.significant
    assert comparison.a12 == 1.0
    mixed = np.where(np.arange(20) < 10, 0.5, INF)
    assert statistics.quantile(mixed, 0.25) == 0.5
    assert statistics.quantile(mixed, 0.5) == INF


@settings(max_examples=60, deadline=None)
@given(values, st.randoms())
def test_nothing_is_ever_nan_and_sides_mirror(sample, random):
    other = random.sample(sample, len(sample))
    [one] = compared(sample, other)
    [two] = compared(other, sample)
    assert 0.0 <= one.p <= 1.0
    assert one.p == pytest.approx(two.p)
    assert one.a12 + two.a12 == pytest.approx(1.0)
    assert 0.0 <= one.low <= one.a12 <= one.high <= 1.0
    practical = [one.practical.better, one.practical.equivalent, one.practical.worse]
    assert sum(practical) == pytest.approx(1.0)
    friedman = statistics.friedman([sample, other, sample[::-1]])
    assert np.isfinite([friedman.statistic, friedman.p, *friedman.mean_ranks]).all()
    assert not np.isnan(statistics.quantile(sample, 0.25))


def test_wilson_interval_is_the_published_one():
    # 0 of 10: upper end z^2 / (n + z^2)
    assert statistics.wilson(0, 10) == pytest.approx((0.0, 3.841458820694124 / 13.841458820694124))
    assert statistics.wilson(81, 263) == pytest.approx((0.2553, 0.3662), abs=5e-5)  # Newcombe 1998, table I
    assert statistics.wilson(0, 0) == (0.0, 1.0)


def test_expected_running_time_charges_failures_their_budget():
    assert statistics.expected_running_time([100, INF, 300], [500, 500, 500]) == (100 + 500 + 300) / 2
    assert statistics.expected_running_time([INF], [500]) == INF


def test_ecdf_steps_at_each_hit():
    assert statistics.ecdf([10, 20, INF, 20], [9, 10, 19, 20, 1000]) == pytest.approx([0, 0.25, 0.25, 0.75, 0.75])


@given(st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=20), st.floats(0, 1))
def test_quantile_is_numpys_where_nothing_failed(sample, q):
    assert statistics.quantile(sample, q) == pytest.approx(np.quantile(sample, q), abs=1e-9)

"""Statistics of repeated trials: arrays in, numbers out; no plugin, no file, no study.

Lower is better throughout. A trial that failed is +inf and so ranks as worst; two failures tie. No answer is NaN:
identical samples give p = 1 and A12 = 0.5. An instance of a problem is a block of every test and interval; a trial
within it is a repeat. Where there is one instance, its trials are the blocks, and what is found holds for it alone.
"""

from hysteresis_bench.statistics.comparison import (
    AT_ODDS,
    CANNOT_TELL,
    SAME,
    TIE,
    TOO_FEW,
    Comparison,
    Sample,
    compare,
    compare_pairs,
    every_pair,
)
from hysteresis_bench.statistics.description import clopper_pearson, ecdf, expected_running_time, quantile, wilson
from hysteresis_bench.statistics.effect_size import a12, a12_interval, magnitude, mean_a12
from hysteresis_bench.statistics.equivalence import REGION, Practical, practical
from hysteresis_bench.statistics.ranks import ENOUGH, LEVEL, Friedman, SignedRank, friedman, holm, signed_rank, wilcoxon
from hysteresis_bench.statistics.resampling import median_interval, running_time_interval

__all__ = [
    "AT_ODDS",
    "CANNOT_TELL",
    "ENOUGH",
    "LEVEL",
    "REGION",
    "SAME",
    "TIE",
    "TOO_FEW",
    "Comparison",
    "Friedman",
    "Practical",
    "Sample",
    "SignedRank",
    "a12",
    "a12_interval",
    "clopper_pearson",
    "compare",
    "compare_pairs",
    "ecdf",
    "every_pair",
    "expected_running_time",
    "friedman",
    "holm",
    "magnitude",
    "mean_a12",
    "median_interval",
    "practical",
    "quantile",
    "running_time_interval",
    "signed_rank",
    "wilcoxon",
    "wilson",
]

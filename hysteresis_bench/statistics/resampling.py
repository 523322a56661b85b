"""Bootstrap intervals over blocks: what another draw of instances might have given.

[1] B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, Chapman and Hall 1993, section 13.3 (percentiles).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array
from hysteresis_bench.statistics.description import quantile

RESAMPLES = 2000
"""Of an interval: 50 of them lie beyond either end of it."""
COVERAGE = 0.95
"""Of all intervals: how often they hold what they are of."""


@lru_cache(maxsize=64)
def counts(blocks: int) -> Array:
    """(RESAMPLES, blocks): how often every resample has each block; always the same ones."""
    drawn = np.random.default_rng([blocks, 0]).integers(blocks, size=(RESAMPLES, blocks))
    found: Array = np.apply_along_axis(np.bincount, 1, drawn, minlength=blocks).astype(float)
    return found


def percentiles(values: Array) -> tuple[float, float]:
    """[1] The interval that holds the middle COVERAGE of the resampled values."""
    return quantile(values, (1.0 - COVERAGE) / 2.0), quantile(values, (1.0 + COVERAGE) / 2.0)


def median_interval(values: ArrayLike) -> tuple[float, float]:
    """[1] 95 % interval of the median; values : (blocks,), inf where failed. (inf, inf) without a block."""
    x = np.sort(np.asarray(values, dtype=float))
    if x.size == 0:
        return float("inf"), float("inf")
    ends = np.cumsum(counts(x.size), axis=1)  # the k-th smallest of a resample is the first block whose end is above k
    middle = [np.argmax(ends > k, axis=1) for k in ((x.size - 1) // 2, x.size // 2)]
    return percentiles(0.5 * (x[middle[0]] + x[middle[1]]))


def running_time_interval(charged: ArrayLike, successes: ArrayLike) -> tuple[float, float]:
    """[1] 95 % interval of the expected running time; of every block the evaluations that are charged and the
    successes, (blocks,) each. inf where a resample has no success."""
    spent, reached = np.asarray(charged, dtype=float), np.asarray(successes, dtype=float)
    if spent.size == 0:
        return float("inf"), float("inf")
    weights = counts(spent.size)
    hits = weights @ reached
    return percentiles(np.divide(weights @ spent, hits, out=np.full(hits.size, np.inf), where=hits > 0.0))

"""How often the one is better than the other: Vargha and Delaney's A12, with an interval.

[1] A. Vargha, H. D. Delaney, J. Educ. Behav. Stat. 25 (2000) 101.  Cliff's delta is 2 A12 - 1.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array
from hysteresis_bench.statistics.resampling import counts, percentiles


def magnitude(a12: float) -> str:
    """A12 in words, thresholds of [1]: 0.56 small, 0.64 medium, 0.71 large."""
    distance = abs(a12 - 0.5)
    return next(word for edge, word in ((0.21, "large"), (0.14, "medium"), (0.06, "small"), (-1.0, "negligible"))
                if distance >= edge - 1e-12)  # fmt: skip


def scores(ours: ArrayLike, theirs: ArrayLike, tie: float = 0.0) -> Array:
    """(ours, theirs): 1 where ours is the lower one, 1/2 where they are equal, or within `tie`; inf is a failure."""
    x, y = np.asarray(ours, dtype=float)[:, None], np.asarray(theirs, dtype=float)[None, :]
    apart = np.abs(np.subtract(x, y, out=np.zeros(np.broadcast_shapes(x.shape, y.shape)), where=x != y)) > tie
    found: Array = np.where(apart, x < y, 0.5)
    return found


def a12(ours: ArrayLike, theirs: ArrayLike, tie: float = 0.0) -> float:
    """[1] P(ours < theirs) + P(equal) / 2 over all pairs; 0.5 where one is empty."""
    found = scores(ours, theirs, tie)
    return float(np.mean(found)) if found.size else 0.5


def mean_a12(ours: Sequence[Array], theirs: Sequence[Array], tie: float = 0.0) -> float:
    """[1] within every instance, and the mean of these: instances of other difficulty do not mix. A sample is an array
    of trials an instance, the same instances in the same order. 0.5 where there is none."""
    each = [a12(*pair, tie) for pair in zip(ours, theirs, strict=True)]
    return float(np.mean(each)) if each else 0.5


def a12_interval(ours: Sequence[Array], theirs: Sequence[Array], tie: float = 0.0) -> tuple[float, float, float]:
    """`mean_a12` and its 95 % bootstrap interval. Resampled are the instances; where there is one, the trials of either
    side."""
    middle = mean_a12(ours, theirs, tie)
    if not sum(map(len, ours)) or not sum(map(len, theirs)):
        return 0.5, 0.0, 1.0
    if len(ours) == 1:
        return middle, *percentiles(_resampled(ours[0], theirs[0], tie))
    each = np.array([a12(*pair, tie) for pair in zip(ours, theirs, strict=True)])
    return middle, *percentiles(counts(each.size) @ each / each.size)


def _resampled(ours: Array, theirs: Array, tie: float) -> Array:
    """(resamples,) A12. In the order of their results, one of ours loses to their first ones, is even with the next and
    beats the last ones: three sums of how often a resample has each, in place of one for every pair."""
    order = np.argsort(theirs, kind="stable")
    found = scores(ours, theirs[order], tie)
    n, m = found.shape
    below = np.cumsum(np.pad(np.take(counts(m, 1), order, axis=1), ((0, 0), (1, 0))), axis=1)
    lost, even = (np.take(below, np.sum(found < score, axis=1), axis=1) for score in (0.5, 1.0))
    resampled: Array = np.einsum("ri,ri->r", counts(n), m - 0.5 * (lost + even)) / (n * m)
    return resampled

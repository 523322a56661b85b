"""How often the one is better than the other: Vargha and Delaney's A12, with an interval.

[1] A. Vargha, H. D. Delaney, J. Educ. Behav. Stat. 25 (2000) 101.  Cliff's delta is 2 A12 - 1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array
from hysteresis_bench.statistics.resampling import counts, percentiles

AT_ONCE = 100_000
"""Of counts that are summed together: as many as stay in a processor's cache."""


def magnitude(a12: float) -> str:
    """A12 in words, thresholds of [1]: 0.56 small, 0.64 medium, 0.71 large."""
    distance = abs(a12 - 0.5)
    return next(word for edge, word in ((0.21, "large"), (0.14, "medium"), (0.06, "small"), (-1.0, "negligible"))
                if distance >= edge - 1e-12)  # fmt: skip


def lost_and_even(ours: ArrayLike, theirs: ArrayLike, tie: float = 0.0) -> tuple[Array, Array]:
    """Of each of ours how many of theirs it loses to, and how many of them it is even with: equal, or within `tie`. An
    infinite one is a failure. (ours,) each, without every pair: of theirs in order, it loses to the first ones, and is
    even with the next."""
    x, ranked = np.asarray(ours, dtype=float), np.sort(np.asarray(theirs, dtype=float))
    lost = _first(x, ranked, lambda mine, other: ~_apart(mine, other, tie) | (mine < other))
    return lost, _first(x, ranked, lambda mine, other: _apart(mine, other, tie) & (mine < other)) - lost


def _apart(x: Array, y: Array, tie: float) -> Array:
    found: Array = np.abs(np.subtract(x, y, out=np.zeros(x.shape), where=x != y)) > tie
    return found


def _first(x: Array, ranked: Array, holds: Callable[[Array, Array], Array]) -> Array:
    """(x,): the place of the first of the ranked values for which it holds, as for all behind it, by bisection; their
    number where there is none. A sum of value and tie would be searched at once, and is rounded otherwise than the
    difference."""
    low, high = np.zeros(x.size, dtype=np.intp), np.full(x.size, ranked.size, dtype=np.intp)
    while (open_ := low < high).any():
        middle = (low + high) // 2
        there = holds(x, ranked[np.minimum(middle, ranked.size - 1)])
        high = np.where(open_ & there, middle, high)
        low = np.where(open_ & ~there, middle + 1, low)
    return low


def a12(ours: ArrayLike, theirs: ArrayLike, tie: float = 0.0) -> float:
    """[1] P(ours < theirs) + P(equal) / 2 over all pairs; 0.5 where one is empty."""
    lost, even = lost_and_even(ours, theirs, tie)
    pairs = lost.size * np.size(theirs)
    return float((pairs - np.sum(lost) - 0.5 * np.sum(even)) / pairs) if pairs else 0.5


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
    beats the last ones: sums of how often a resample has each, in place of one for every pair."""
    order = np.argsort(theirs, kind="stable")
    lost, even = lost_and_even(ours, theirs, tie)
    n, m = ours.size, theirs.size
    mine, others = counts(n), counts(m, 1)
    resampled = np.empty(len(mine))
    below = np.zeros((-(-len(mine) // max(1, len(mine) * m // AT_ONCE)), m + 1))
    for begun in range(0, len(mine), len(below)):
        part = slice(begun, begun + len(below))
        summed = below[: len(mine[part])]
        np.cumsum(np.take(others[part], order, axis=1), axis=1, out=summed[:, 1:])
        missed = np.take(summed, lost, axis=1) + np.take(summed, lost + even, axis=1)
        resampled[part] = n * m - 0.5 * np.einsum("ri,ri->r", mine[part], missed)
    return resampled / (n * m)

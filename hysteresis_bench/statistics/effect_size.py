"""How often the one is better than the other: Vargha and Delaney's A12, with an interval.

[1] A. Vargha, H. D. Delaney, J. Educ. Behav. Stat. 25 (2000) 101.  Cliff's delta is 2 A12 - 1.
[2] E. L. Korn, B. I. Graubard, Surv. Methodol. 24 (1998) 193: Clopper and Pearson's interval with an effective number,
    for rates near 0 or 1 over blocks.
[3] E. R. DeLong, D. M. DeLong, D. L. Clarke-Pearson, Biometrics 44 (1988) 837.
[4] Z. W. Birnbaum, O. M. Klose, Ann. Math. Stat. 28 (1957) 933.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array
from hysteresis_bench.statistics.description import clopper_pearson


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
    """`mean_a12` and its 95 % interval, which knows that A12 ends at 0 and 1: of as many independent trials of a yes or
    no as the values are worth [2]. It is wide where one side always wins: (0.77, 1) of 14 trials or instances."""
    middle = mean_a12(ours, theirs, tie)
    if not sum(map(len, ours)) or not sum(map(len, theirs)):
        return 0.5, 0.0, 1.0
    worth = _of_trials(ours[0], theirs[0], tie) if len(ours) == 1 else _of_instances(ours, theirs, tie)
    low, high = clopper_pearson(middle * worth, worth)
    return middle, min(low, middle), max(high, middle)


def _of_instances(ours: Sequence[Array], theirs: Sequence[Array], tie: float) -> float:
    """What the instances are worth: their number where A12 is 0 or 1 on each, more where they are alike."""
    each = np.array([a12(*pair, tie) for pair in zip(ours, theirs, strict=True)])
    return each.size / _spread(each)


def _of_trials(ours: Array, theirs: Array, tie: float) -> float:
    """What the trials of one instance are worth. [3] The variance is that of either side's shares of the other side
    over its trials, and [4] never more than that of the smaller side's trials alone."""
    lost, even = lost_and_even(ours, theirs, tie)
    beaten, same = lost_and_even(theirs, ours, tie)
    spreads = (_spread((lost + 0.5 * even) / theirs.size), _spread((beaten + 0.5 * same) / ours.size))
    return max(min(ours.size, theirs.size), 1.0 / (spreads[0] / ours.size + spreads[1] / theirs.size))


def _spread(shares: Array) -> float:
    """The variance over that of a yes or no of the same mean, in (0, 1]; shares : (blocks,) in [0, 1]

    Ours: half a share of 0 and half one of 1 stand beside those found, as a few that are alike do not prove that there
    is no other.
    """
    count = shares.size + 1.0
    mean, square = (np.sum(shares) + 0.5) / count, (np.sum(shares**2) + 0.5) / count
    return float((square - mean**2) / (mean * (1.0 - mean)))

"""Better, equivalent or worse: probabilities of the Bayesian signed-rank test with a region of practical equivalence.

[1] A. Benavoli, G. Corani, J. Demšar, M. Zaffalon, Time for a Change: a Tutorial for Comparing Multiple Classifiers
    Through Bayesian Analysis, J. Mach. Learn. Res. 18 (2017) 77, section 4.1.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import log

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array
from hysteresis_bench.statistics.ranks import differences

REGION = log(1.01)
"""Values are logarithms: errors within 1 % of each other make no difference in practice."""

PRIOR = 0.5
"""[1] Strength of the prior, one pseudo-observation of no difference."""
DRAWS = 20_000
"""Of the weights: a probability is known to 0.0035 (one standard error at most)."""

MAJORITY = 0.6
"""Share of all values in one region from which their weights alone are looked at first."""
ROUNDING = 1e-9
"""Of sums of weights."""

AT_ONCE = 100_000
"""Weights that are summed together: as many as stay in a processor's cache."""


@dataclass(frozen=True)
class Practical:
    """Probabilities that ours is better, that both are equivalent in practice, that ours is worse; they add up to 1."""

    better: float
    equivalent: float
    worse: float


def practical(ours: ArrayLike, theirs: ArrayLike, region: float = REGION) -> Practical:
    """[1] Of paired values, (blocks,) each, lower is better.

    The differences z_0 (the prior's, 0) to z_n have weights from a Dirichlet distribution; a draw favours that of the
    three regions which holds the largest weight of the sums z_i + z_j (Walsh averages, as in the signed-rank test).
    """
    z = np.concatenate([[0.0], differences(ours, theirs)])
    order = np.argsort(z, kind="stable")
    sums = _Sums(z[order], region)
    weights = _weights(z.size)
    favoured = sums.certain(weights, order)
    for part in np.array_split(open_ := np.flatnonzero(favoured < 0), max(1, open_.size * z.size // AT_ONCE)):
        # clipped as no index is outside: where numpy looks for one, it takes three times as long
        ranked = np.take(weights[part], order, axis=1, mode="clip", out=np.empty((part.size, z.size)))
        favoured[part] = np.argmax(sums.shares(ranked), axis=0)
    return Practical(*map(float, np.bincount(favoured, minlength=3) / DRAWS))


class _Sums:
    """Sums z_i + z_j of ranked values, (n,), in three regions: below -2 region, between, above 2 region.

    Two values that lie in the same region have their sum there, too.
    """

    def __init__(self, ranked: Array, region: float) -> None:
        # of values that lie below, how many have a sum there with each: these and others; the same from above
        self._below, self._above = (_partners(side, -2.0 * region) for side in (ranked, -ranked[::-1]))
        self._ends = np.array([0, self._below.size, ranked.size - self._above.size, ranked.size])

    def certain(self, weights: Array, order: Array) -> Array:
        """(draws,): the region of the largest weight where the values in it alone tell so: they have more than half of
        all pairs. -1 where they do not. weights : (draws, n) of the values in the order before they were ranked"""
        found = np.full(len(weights), -1)
        region = int(np.argmax(sizes := np.diff(self._ends)))
        if sizes[region] > MAJORITY * order.size:
            outside = np.zeros(len(weights))
            others = np.delete(order, slice(*self._ends[region : region + 2]))
            for part in np.array_split(np.arange(len(weights)), max(1, len(weights) * others.size // AT_ONCE)):
                outside[part] = np.sum(weights[part[0] : part[-1] + 1, others], axis=1)
            found[(1.0 - outside) ** 2 > 0.5 + ROUNDING] = region
        return found

    def shares(self, weights: Array) -> Array:
        """(3, draws): the weights of the sums in each region; weights : (draws, n) of the ranked values

        Two that lie below always are a pair below, two others never, and one of either is one twice.
        """
        _, low, high, n = self._ends
        summed = np.zeros((len(weights), n + 1))
        np.cumsum(weights, axis=1, out=summed[:, 1:])
        taken, shares = np.empty(weights.size), np.zeros((3, len(weights)))
        if low:
            mixed = _products(weights[:, :low], summed, self._below, taken)
            shares[0] = 2.0 * mixed - summed[:, low] ** 2
        if high < n:
            # theirs are the last ones: what is left of all weights behind the others
            own = summed[:, n] - summed[:, high]
            mixed = summed[:, n] * own - _products(weights[:, high:], summed, n - self._above[::-1], taken)
            shares[2] = 2.0 * mixed - own**2
        shares[1] = 1.0 - shares[0] - shares[2]
        return shares


def _products(weights: Array, summed: Array, places: Array, taken: Array) -> Array:
    """(draws,): sums of weights, each times a sum of the others. places : of these sums;  taken : room for them"""
    room = taken[: weights.size].reshape(weights.shape)
    found: Array = np.einsum("di,di->d", weights, np.take(summed, places, axis=1, mode="clip", out=room))
    return found


def _partners(ranked: Array, edge: float) -> Array:
    """Of each value that has a sum below the edge with itself, how many of the ranked values do; falling."""
    partners = np.searchsorted(ranked, edge - ranked, side="left")
    found: Array = partners[partners > np.arange(ranked.size)]
    return found


@lru_cache(maxsize=16)
def _weights(size: int) -> Array:
    """(DRAWS, size) of the Dirichlet distribution, always the same ones."""
    strength = np.concatenate([[PRIOR], np.ones(size - 1)])
    drawn: Array = np.random.default_rng(size).dirichlet(strength, DRAWS)
    return drawn

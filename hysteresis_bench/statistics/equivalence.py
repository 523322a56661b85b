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
    # of the sums with z_i those below the region are with the first of the others in order, those above with the last
    ranked = z[order]
    first = np.searchsorted(ranked, -2 * region - ranked, side="left")
    last = np.searchsorted(ranked, 2 * region - ranked, side="right")
    shares = np.empty((3, DRAWS))
    for part in np.array_split(np.arange(DRAWS), max(1, DRAWS * z.size // AT_ONCE)):
        weights = np.take(_weights(z.size)[part], order, axis=1)
        below = np.cumsum(np.pad(weights, ((0, 0), (1, 0))), axis=1)
        shares[0, part] = np.einsum("di,di->d", weights, np.take(below, first, axis=1))
        shares[2, part] = np.einsum("di,di->d", weights, below[:, -1:] - np.take(below, last, axis=1))
    shares[1] = 1.0 - shares[0] - shares[2]
    favoured = np.bincount(np.argmax(shares, axis=0), minlength=3) / DRAWS
    return Practical(*map(float, favoured))


@lru_cache(maxsize=16)
def _weights(size: int) -> Array:
    """(DRAWS, size) of the Dirichlet distribution, always the same ones."""
    strength = np.concatenate([[PRIOR], np.ones(size - 1)])
    drawn: Array = np.random.default_rng(size).dirichlet(strength, DRAWS)
    return drawn

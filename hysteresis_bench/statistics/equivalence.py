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
    sums = z[:, None] + z[None, :]
    weights = _weights(z.size)
    better, worse = (
        np.sum((weights @ where.astype(float)) * weights, axis=1) for where in (sums < -2 * region, sums > 2 * region)
    )
    shares = np.stack([better, 1.0 - better - worse, worse])
    favoured = np.bincount(np.argmax(shares, axis=0), minlength=3) / DRAWS
    return Practical(*map(float, favoured))


@lru_cache(maxsize=16)
def _weights(size: int) -> Array:
    """(DRAWS, size) of the Dirichlet distribution, always the same ones."""
    strength = np.concatenate([[PRIOR], np.ones(size - 1)])
    drawn: Array = np.random.default_rng(size).dirichlet(strength, DRAWS)
    return drawn

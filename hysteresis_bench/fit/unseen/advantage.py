"""The comparison of two systems by blocked cross-validation inside the fitted records."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.blocks import Blocks

CLEAR = 2.0
"""Standard errors by which one system must be better."""


def advantage(ours: Array, theirs: Array, blocks: Blocks) -> float:
    """By how many standard errors our mean square is smaller, paired over blocks; ours, theirs : (samples,).

    Of the mean gain, or of the gains' signed ranks (Wilcoxon) where these agree and say more: one block that
    gains far more than the others, such as a first cycle, makes a mean uncertain that no block contradicts.
    """
    gains = _gains(ours, theirs, blocks)
    if np.mean(gains) == 0.0:
        return 0.0
    by_mean, by_rank = _of_mean(gains), _signed_ranks(gains)
    return by_rank if by_rank * by_mean > 0.0 and abs(by_rank) > abs(by_mean) else by_mean


def chance(ours: Array, theirs: Array, blocks: Blocks) -> float:
    """The p-value of our mean square being smaller, paired over blocks; ours, theirs : (samples,).

    Of the mean gain (Student) or of the gains' signed ranks (Wilcoxon, exact for few blocks), twice the smaller one
    (Bonferroni): `advantage` is the larger of the two, and no normal variable.
    """
    from scipy.special import stdtr
    from scipy.stats import wilcoxon

    gains = _gains(ours, theirs, blocks)
    if gains.size < 2 or not np.any(gains):
        return 1.0
    by_mean = float(stdtr(gains.size - 1, -_of_mean(gains)))
    by_rank = float(wilcoxon(gains, zero_method="pratt", alternative="greater").pvalue)
    return min(1.0, 2.0 * min(by_mean, by_rank))


def _gains(ours: Array, theirs: Array, blocks: Blocks) -> Array:
    """Of the mean square of every block (blocks,)."""
    samples = np.bincount(blocks.block)
    gains: Array = np.bincount(blocks.block, theirs**2 - ours**2)[samples > 0] / samples[samples > 0]
    return gains


def _of_mean(gains: Array) -> float:
    """The mean in standard errors."""
    mean, error = float(np.mean(gains)), float(np.std(gains, ddof=1)) / np.sqrt(gains.size)
    return mean / error if error > 0.0 else float(np.sign(mean)) * np.inf


def _signed_ranks(gains: Array) -> float:
    """Wilcoxon's statistic in standard errors of the null, normal approximation."""
    from scipy.stats import rankdata

    ranks = rankdata(np.abs(gains)) * np.sign(gains)
    return float(ranks.sum() / np.sqrt((ranks**2).sum()))

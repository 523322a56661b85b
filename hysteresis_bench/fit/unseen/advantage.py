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
    samples = np.bincount(blocks.block)
    gains = np.bincount(blocks.block, theirs**2 - ours**2)[samples > 0] / samples[samples > 0]
    mean, error = float(np.mean(gains)), float(np.std(gains, ddof=1)) / np.sqrt(gains.size)
    if mean == 0.0:
        return 0.0
    by_mean = mean / error if error > 0.0 else float(np.sign(mean)) * np.inf
    by_rank = _signed_ranks(gains)
    return by_rank if by_rank * by_mean > 0.0 and abs(by_rank) > abs(by_mean) else by_mean


def _signed_ranks(gains: Array) -> float:
    """Wilcoxon's statistic in standard errors of the null, normal approximation."""
    from scipy.stats import rankdata

    ranks = rankdata(np.abs(gains)) * np.sign(gains)
    return float(ranks.sum() / np.sqrt((ranks**2).sum()))

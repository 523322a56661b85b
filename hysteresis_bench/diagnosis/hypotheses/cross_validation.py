"""Blocked cross-validation inside the fitted records, and the comparison of two systems by it.

Every record is cut into contiguous blocks, dealt to the folds in turn. A record is always simulated whole, so
that its memory is right; a fold's blocks do not count when the parameters are fitted. All folds are fitted at
once, as chains of one swarm, from the fit to all samples.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.blocks import Blocks, blocked
from hysteresis_bench.fit.least_squares import descend, errors
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.signals import Record

FOLDS = 4
BLOCKS = 48
"""Of all records together, at least FOLDS a record."""

ITERATIONS = 4
"""From the fit to all samples to that of three quarters of them is a small step."""

FURTHER = 15
"""A fit without one whole record is further away than one without a few blocks."""

CLEAR = 2.0
"""Standard errors by which one system must be better."""


def cut(records: Sequence[Record]) -> Blocks:
    """Blocks of the records' scored samples."""
    samples = np.array([record.measured.size for record in records])
    counts = np.maximum(FOLDS, np.rint(BLOCKS * samples / samples.sum() / FOLDS).astype(int) * FOLDS)
    return blocked(samples.tolist(), counts.tolist(), FOLDS, turn=1, shift=1)


def left_out_errors(problem: Problem, point: Array, blocks: Blocks, iterations: int = ITERATIONS) -> Array:
    """Errors (scored samples,) of every sample by the fit that did not count it; point : (dimension,)."""
    starts = np.repeat(point[:, None], blocks.folds, axis=1)
    points, _ = descend(problem, starts, blocks.training, iterations=iterations)
    return errors(problem, points)[np.arange(blocks.fold.size), blocks.fold]


def unseen_errors(problem: Problem, point: Array) -> Array:
    """Errors (scored samples,) of every record by a fit to the others; point : (dimension,) in the unit box."""
    sizes = [record.measured.size for record in problem.records]
    number = np.repeat(np.arange(len(sizes)), sizes)
    return left_out_errors(problem, point, Blocks(number, number, len(sizes)), FURTHER)


def advantage(ours: Array, theirs: Array, blocks: Blocks) -> float:
    """By how many standard errors our mean square is smaller, paired over blocks; ours, theirs : (samples,).

    Of the mean gain, or of the gains' signed ranks (Wilcoxon) where these agree and say more: one block that
    gains far more than the others, such as a first cycle, makes a mean uncertain that no block contradicts.
    """
    gains = np.bincount(blocks.block, theirs**2 - ours**2) / np.bincount(blocks.block)
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

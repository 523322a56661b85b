"""Errors of samples by fits that did not count them: blocks of every record, or whole records.

Every record is cut into contiguous blocks, dealt to the folds in turn. A record is always simulated whole, so
that its memory is right; a fold's blocks do not count when the parameters are fitted. All folds are fitted at
once, as chains of one swarm, from the fit to all samples.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.least_squares import descend, errors
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.unseen.blocks import Blocks, blocked
from hysteresis_bench.signals import Record

FOLDS = 4
BLOCKS = 48
"""Of all records together, at least FOLDS a record."""

ITERATIONS = 4
"""From the fit to all samples to that of three quarters of them is a small step."""

FURTHER = 15
"""A fit without one whole record is further away than one without a few blocks."""


def cut(records: Sequence[Record]) -> Blocks:
    """Blocks of the records' scored samples."""
    samples = np.array([record.measured.size for record in records])
    counts = np.maximum(FOLDS, np.rint(BLOCKS * samples / samples.sum() / FOLDS).astype(int) * FOLDS)
    return blocked(samples.tolist(), counts.tolist(), FOLDS, turn=1, shift=1)


def left_out_errors(problem: Problem, point: Array, blocks: Blocks, iterations: int = ITERATIONS) -> Array:
    """Errors (scored samples,) of every sample by the fit that did not count it; point : (dimension,)."""
    return errors_without(problem, point, blocks, iterations)[np.arange(blocks.fold.size), blocks.fold]


def errors_without(problem: Problem, point: Array, blocks: Blocks, iterations: int = FURTHER) -> Array:
    """Errors (scored samples, folds) of all samples by the fits without each fold; point : (dimension,)."""
    starts = np.repeat(point[:, None], blocks.folds, axis=1)
    points, _ = descend(problem, starts, blocks.training, iterations=iterations)
    return errors(problem, points)


def unseen_errors(problem: Problem, point: Array) -> Array:
    """Errors (scored samples,) of every record by a fit to the others; point : (dimension,) in the unit box."""
    sizes = [record.measured.size for record in problem.records]
    number = np.repeat(np.arange(len(sizes)), sizes)
    return left_out_errors(problem, point, Blocks(number, number, len(sizes)), FURTHER)

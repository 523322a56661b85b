"""What every law must beat: a cubic polynomial of the input, without memory, with a constant of each record's own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.signals import Record

DEGREE = 3


@dataclass(frozen=True, eq=False)
class Polynomial:
    """coefficients : (DEGREE,) of the powers 1, 2, 3 of (input - centre) / half_span."""

    coefficients: Array
    centre: float
    half_span: float

    def errors(self, record: Record) -> Array:
        """Measured minus fitted, (scored samples,), with the constant that suits the record best."""
        left: Array = record.measured - self._powers(record) @ self.coefficients
        centred: Array = left - np.mean(left)
        return centred

    def _powers(self, record: Record) -> Array:
        share = (record.input[record.scored] - self.centre) / self.half_span
        powers: Array = share[:, None] ** np.arange(1, DEGREE + 1)
        return powers


def polynomial(records: Sequence[Record], counts: Array | None = None) -> Polynomial:
    """Least squares over the scored samples of all records; counts : (scored samples,), false where one is left out."""
    low = min(float(np.min(record.input[record.scored])) for record in records)
    high = max(float(np.max(record.input[record.scored])) for record in records)
    empty = Polynomial(np.zeros(DEGREE), 0.5 * (low + high), 0.5 * (high - low) or 1.0)
    powers = [empty._powers(record) for record in records]
    columns = np.concatenate([part - part.mean(axis=0) for part in powers])
    target = np.concatenate([record.measured - np.mean(record.measured) for record in records])
    kept = slice(None) if counts is None else counts
    solution = np.linalg.lstsq(columns[kept], target[kept], rcond=None)[0]
    return Polynomial(solution, empty.centre, empty.half_span)


def baseline_ahead(records: Sequence[Record], last: Array) -> Array:
    """Errors of the samples of a last part, by the polynomial of those before it;  last : (scored samples,)"""
    if not last.any():
        return np.empty(0)
    plain = polynomial(records, ~last)
    return np.concatenate([plain.errors(record) for record in records])[last]


def baseline_errors(records: Sequence[Record], blocks: Blocks) -> Array:
    """Errors (scored samples,) of every sample by the polynomial of those that are not left out with it."""
    found = np.empty(blocks.fold.size)
    for fold in range(blocks.folds):
        out = blocks.fold == fold
        plain = polynomial(records, ~out)
        found[out] = np.concatenate([plain.errors(record) for record in records])[out]
    return found

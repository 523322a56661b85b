"""What every law must beat: a cubic polynomial of the input, without memory, with a constant of each record's own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
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


def polynomial(records: Sequence[Record]) -> Polynomial:
    """Least squares over the scored samples of all records."""
    low = min(float(np.min(record.input[record.scored])) for record in records)
    high = max(float(np.max(record.input[record.scored])) for record in records)
    empty = Polynomial(np.zeros(DEGREE), 0.5 * (low + high), 0.5 * (high - low) or 1.0)
    powers = [empty._powers(record) for record in records]
    columns = np.concatenate([part - part.mean(axis=0) for part in powers])
    target = np.concatenate([record.measured - np.mean(record.measured) for record in records])
    solution = np.linalg.lstsq(columns, target, rcond=None)[0]
    return Polynomial(solution, empty.centre, empty.half_span)


def baseline_errors(records: Sequence[Record]) -> Array:
    """Errors of all records, (scored samples,), each predicted by the polynomial of the others; of a lone record its
    own fit's."""
    if len(records) == 1:
        return polynomial(records).errors(records[0])
    others = [[other for other in records if other is not record] for record in records]
    return np.concatenate([polynomial(rest).errors(record) for rest, record in zip(others, records, strict=True)])

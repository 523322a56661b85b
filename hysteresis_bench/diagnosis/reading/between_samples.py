"""How far does a simulation depend on what lies between the samples?

A model of the samples takes the input for straight between them, misses the very peak of a reversal, and where its law
is integrated, such as Jiles-Atherton, is off where few samples pass a steep part of its loop. It cannot come down to
the noise then, and an effect that bends the loop a little may be taken for what is missing. So where it matters the
search is made again with `FINER` steps from one sample to the next, along a spline where the input is smooth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.preparation import SEARCHED
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.accuracy import simulated
from hysteresis_bench.signals import Record

TELLING = 0.3
"""Of the floor, from where it matters: it adds 4 % to what a perfect model leaves. Where the law is wrong, of what the
selected system leaves."""

DECIDING = 5.0
"""Of the floor's standard error, the floor over the root of the number of samples, from where it may decide between
names: the square of it is what it adds to a chi-square. Lags were named on the wrong side of the law at 6.6 to 10; with
twice it they still are, with half of it well sampled loops are simulated four times as finely too."""

FINER = 4
"""Steps: what is left of an arc between two samples, and of the error of a law of second order, is a sixteenth."""


def with_finer_steps(records: Sequence[Record]) -> tuple[Record, ...]:
    """Every record simulated with `FINER` times its steps."""
    return tuple(replace(record, steps=FINER * record.steps) for record in records)


def between_samples(system: System, records: Sequence[Record], values: Array) -> float:
    """RMS of what finer steps change of the response, unit of the output; 0 without a record.

    values : (dimension,), in units
    """
    plain, fine = (simulated(system, each, values) for each in (records, with_finer_steps(records)))
    changes = [one - other for one, other in zip(plain, fine, strict=True)]
    return float(np.sqrt(np.mean(np.concatenate(changes) ** 2))) if changes else 0.0


def few_samples(found: Found) -> bool:
    """Does it matter to what was found, or to the bare law, for which an effect may make up? Not asked where there are
    so many samples that a search takes some of them only."""
    fitter, floor = found.full, found.selection.floor
    records = fitter.stack.records
    samples = sum(record.measured.size for record in records)
    if samples > SEARCHED:
        return False
    left = found.best.rmse
    limit = TELLING * left if left > WRONG * floor else floor * min(TELLING, DECIDING / np.sqrt(samples))
    systems = (fitter.fitted(hypothesis) for hypothesis in (found.base, found.best))
    return any(between_samples(system, records, values) > limit for system, values in systems)

"""How far does a simulation depend on what lies between the samples?

A model of the samples takes the input for straight between them, misses the very peak of a reversal, and where its law
is integrated, such as Jiles-Atherton, is off where few samples pass a steep part of its loop.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.data.units import rounded
from hysteresis_bench.fit.accuracy import simulated
from hysteresis_bench.signals import Record

TELLING = 0.3
"""Of what a perfect model leaves, from where it matters: it adds 4 % to that, half of it 1 %, twice it 17 %."""

SHOWN = 1e-3
"""Of the prediction's range, what counts as left at least: less is seen on no bench."""

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


def few_told(system: System, record: Record, values: Array, left: float) -> str:
    """A sentence where it matters to the prediction of a record; "" where it does not.

    values : as above;  left : RMSE of the fit, unit of the output
    """
    change, made = between_samples(system, (record,), values), system.respond(record, values[:, None])
    if not change > TELLING * max(left, SHOWN * float(np.ptp(made))):  # nor where the response is not finite
        return ""
    times = f", {rounded(change / left)} times what the fit left" if left > 0.0 else ""
    return (
        f"record {record.name}: its samples are few for this model: {FINER} steps from one to the next, along a smooth "
        f"curve where the input is smooth, change the prediction by {change:.2g} (RMS){times}. Sample the input faster."
    )

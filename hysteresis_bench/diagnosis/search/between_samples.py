"""How far does the answer of a law depend on the steps in which it is integrated?

A law that is solved in closed form from sample to sample answers alike however many samples lie on a straight way. One
that is integrated, such as Jiles-Atherton, is off where few samples pass a steep part of its loop: a model of those
samples cannot come down to the noise, and an effect that bends the loop a little may be taken for what is missing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.fit.accuracy import simulated
from hysteresis_bench.signals import Record

TELLING = 0.3
"""Of the floor, from where the error of the steps is told: it adds 4 % to what a perfect model leaves."""


def between_samples(system: System, records: Sequence[Record], values: Array) -> float:
    """RMS error of the steps, unit of the output: 4/3 of what changes where each is made as two halves (Richardson), as
    the laws here that are integrated are of second order.

    values : (dimension,), in units; 0 without a record
    """
    whole = simulated(system, records, values)
    halves = simulated(system, [_halved(record) for record in records], values)
    changes = [one - other[::2] for one, other in zip(whole, halves, strict=True)]
    return 4.0 / 3.0 * float(np.sqrt(np.mean(np.concatenate(changes) ** 2))) if changes else 0.0


def _halved(record: Record) -> Record:
    places = np.arange(2 * record.time.size - 1) / 2

    def between(values: Array) -> Array:
        return np.interp(places, np.arange(values.size), values)

    columns = {name: between(values) for name, values in record.columns.items()}
    time, u = between(record.time), between(record.input)
    return replace(record, time=time, input=u, output=None, columns=columns, history=2 * record.history)

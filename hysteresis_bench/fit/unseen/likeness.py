"""Is what is asked like what was fitted? Then what was left out of the fits is like it too, and its error alone counts.

An input is described by what a law may know of it: its lowest and highest value, as shares of the span of all fitted
ones, and how fast it moves and how often it goes to and fro, as logarithms. Two are as far apart as the largest
difference of these. Fitted records that were left out whole are each predicted from others at some distance. Where the
inputs held out stay in the range and among the speeds of the fitted ones, and none is much farther from its nearest
one, predicting them is no harder than what the laws were judged by. Only inputs are looked at.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.interval import BEYOND as OTHER
from hysteresis_bench.fit.unseen.interval import speed
from hysteresis_bench.fit.unseen.whole import BEYOND, LeftOut, left_out
from hysteresis_bench.signals import Dataset, Record

FARTHER = 1.5
"""Times the largest distance at which a fitted record was left out: of inputs evenly apart one is left out as far from
its neighbours as one that is held out between them, and few are evenly apart. On made data (benchmarks/law_choice.py)
several shapes and nested amplitudes are like with half and with twice of it; a middle frequency is in 8 of 8 draws, and
in 2 with half."""

LOW, HIGH, RATE = range(3)
"""Columns of a description."""
FASTER = float(np.log(OTHER))


def judged(records: Sequence[Record], dataset: Dataset) -> LeftOut:
    """What is left out of the records' fits, and whether what the data set holds out is like it.

    records : those that the data set has for fits, maybe thinned
    """
    out = left_out(records)
    return replace(out, like=_alike(dataset, out))


def _alike(dataset: Dataset, out: LeftOut) -> bool:
    if not (out.telling and out.whole and dataset.held_out):
        return False
    inputs = [record.input[record.scored] for record in dataset.fitted]
    span = float(np.ptp(np.concatenate(inputs)))
    fitted, asked = (_described(records, span) for records in (dataset.fitted, dataset.held_out))
    within = all(
        np.max(side * asked[:, k]) <= np.max(side * fitted[:, k]) + slack
        for side, k, slack in ((-1.0, LOW, BEYOND), (1.0, HIGH, BEYOND), (-1.0, RATE, FASTER), (1.0, RATE, FASTER))
    )
    judged = max(_nearest(fitted[k], np.delete(fitted, k, axis=0)) for k in out.whole)
    return within and max(_nearest(one, fitted) for one in asked) <= FARTHER * judged


def _described(records: Sequence[Record], span: float) -> Array:
    """(records, 4); span : of the fitted inputs, above 0 where records are left out whole"""
    rows = []
    for record in records:
        u = record.input[record.scored]
        to_and_fro = float(np.sum(np.abs(np.diff(u)))) / (float(np.ptp(u)) or 1.0)
        rate = speed(record) / span if record.timed else 0.0
        logarithms = [float(np.log(one)) if one > 0.0 else 0.0 for one in (rate, to_and_fro)]
        rows.append([float(u.min()) / span, float(u.max()) / span, *logarithms])
    return np.array(rows)


def _nearest(one: Array, others: Array) -> float:
    return float(np.min(np.max(np.abs(others - one), axis=1)))

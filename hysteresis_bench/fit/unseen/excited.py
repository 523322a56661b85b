"""What the fitted records went through: their ranges, and how often and how far the inputs went between two reversals.

Of anything else a model guesses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.fit.unseen.interval import BEYOND
from hysteresis_bench.kernels.turning_points import turning_points
from hysteresis_bench.signals import Record

FREQUENCY, AMPLITUDE = "frequency", "amplitude"
TURN = 0.05
"""Share of a record's input range beyond which a reversal is meant."""

Excited = Mapping[str, Sequence[float]]
"""Lowest and highest FREQUENCY, cycles a unit of time, and AMPLITUDE, unit of the input."""


def ranges(records: Sequence[Record], preparation: Preparation) -> dict[str, list[float]]:
    """Of input and output as they were measured; records : as the model sees them."""
    inputs = [preparation.measured_input(float(edge(r.input))) for r in records for edge in (np.min, np.max)]
    outputs = [float(edge(r.measured)) for r in records for edge in (np.min, np.max)]
    return {"input": [min(inputs), max(inputs)], "output": [min(outputs), max(outputs)]}


def excited(records: Sequence[Record]) -> dict[str, list[float]]:
    """Of the half cycles of the scored inputs; without FREQUENCY where time is only an index."""
    frequencies, amplitudes = [], []
    for record in records:
        time, driven = record.time[record.scored], np.ascontiguousarray(record.input[record.scored], dtype=float)
        at = np.asarray(turning_points(driven, TURN * float(np.ptp(driven))))
        if at.size < 2:  # no whole half cycle: its parts
            at = np.unique([0, *at, driven.size - 1])
        amplitudes += [0.5 * np.abs(np.diff(driven[at]))]
        frequencies += [0.5 / np.diff(time[at])] if record.timed else []
    kinds = {FREQUENCY: frequencies, AMPLITUDE: amplitudes}
    edges = {kind: np.concatenate(values) for kind, values in kinds.items() if values}
    return {kind: [float(np.min(values)), float(np.max(values))] for kind, values in edges.items() if values.size}


def unlike(known: Excited, own: Excited) -> list[str]:
    """In what an input differs from the fitted ones, as words; BEYOND times are still alike."""
    words = {FREQUENCY: ("slower", "faster"), AMPLITUDE: ("smaller", "larger")}
    found = []
    for kind, (below, above) in words.items():
        if kind in known and kind in own:
            (low, high), (least, most) = known[kind], own[kind]
            found += [below] * (least * BEYOND < low) + [above] * (most > high * BEYOND)
    return found

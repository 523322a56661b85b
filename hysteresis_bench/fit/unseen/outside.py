"""How far a law leaves the range of the fitted outputs on inputs that are held out. Only these inputs are looked at."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.whole import BEYOND
from hysteresis_bench.signals import Dataset


def outside(responses: Sequence[Array], dataset: Dataset) -> float:
    """As a share of that range, where the held-out inputs lie within the fitted ones; 0 where nothing is held out.

    responses : (scored samples,) to every held-out record
    """
    inputs = np.concatenate([record.input[record.scored] for record in dataset.fitted])
    outputs = np.concatenate([record.measured for record in dataset.fitted])
    slack, low, high = BEYOND * float(np.ptp(inputs)), float(outputs.min()), float(outputs.max())
    most = 0.0
    for record, response in zip(dataset.held_out, responses, strict=True):
        driven = record.input[record.scored]
        inside = response[(driven >= inputs.min() - slack) & (driven <= inputs.max() + slack)]
        if inside.size:
            most = max(most, low - float(inside.min()), float(inside.max()) - high)
    return most / (high - low) if high > low else 0.0

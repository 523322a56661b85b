"""How far a law leaves the range of the fitted outputs on inputs that are held out. Only these inputs are looked at."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.whole import BEYOND
from hysteresis_bench.signals import Dataset


def outside(responses: Sequence[Array], dataset: Dataset) -> float:
    """As a share of that range, over held-out records whose inputs stay within the fitted ones; 0 where there is none.

    A device that is driven further may rightly go beyond, on its way back too.

    responses : (scored samples,) to every held-out record
    """
    inputs = np.concatenate([record.input[record.scored] for record in dataset.fitted])
    outputs = np.concatenate([record.measured for record in dataset.fitted])
    slack, low, high = BEYOND * float(np.ptp(inputs)), float(outputs.min()), float(outputs.max())
    most = 0.0
    for record, response in zip(dataset.held_out, responses, strict=True):
        driven = record.input[record.scored]
        if driven.min() >= inputs.min() - slack and driven.max() <= inputs.max() + slack:
            most = max(most, low - float(response.min()), float(response.max()) - high)
    return most / (high - low) if high > low else 0.0

"""Loss: RMSE and the papers' fitness forms, each an increasing function of the sum of squared errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array


@dataclass(frozen=True)
class Loss:
    """of(squares, samples, scale) -> loss; squares : (swarm,) sum of squared errors over all scored
    samples, samples : their number, scale : largest |output| measured."""

    name: str
    unit: str
    source: str
    of: Callable[[Array, int, float], Array]


LOSSES: dict[str, Loss] = {
    loss.name: loss
    for loss in (
        Loss(
            "rmse",
            "{output}",
            "root mean square error; PEA paper eq. (6)",
            lambda squares, samples, scale: np.sqrt(squares / samples),
        ),
        Loss(
            "relative-rms-per-root-sample",
            "1",
            "SMA paper eq. (20), (28): (1/E) sqrt(sum (e / y_max)^2) = relative RMS / sqrt(E)",
            lambda squares, samples, scale: np.sqrt(squares) / (samples * scale),
        ),
        Loss(
            "sum-of-squares",
            "{output}^2",
            "GMA paper eq. (20)",
            lambda squares, samples, scale: squares,
        ),
    )
}

"""The RMS error below which nothing is judged."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.diagnosis.evidence.noise import Noise, unresolved
from hysteresis_bench.diagnosis.evidence.view import View

FINEST = 5e-4
"""Share of the output's range below which an error is rounding and numerics, whatever the noise."""

WRONG = 2.0
"""Times the floor that a system may leave before its law is doubted, and the names of effects with it."""


def floor_of(views: Sequence[View], noise: Noise) -> float:
    """RMS below which nothing is judged: noise (pooled over the records), what lies between the samples, rounding."""
    span = max(float(np.ptp(view.y)) for view in views)
    return max(float(np.hypot(noise.floor, unresolved([view.record for view in views]))), FINEST * span)

"""How much the formulas change by which effects are hidden in made data."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import HiddenForm, Hiding
from hysteresis_bench.testing.examples import lock

DURATION, SAMPLES, FASTEST = 3.0, 6400, 4.0
"""s, samples, and Hz of the fastest drive, as made data have them."""
STRENGTHS = (0.3, 1.0)


def changes(form: HiddenForm) -> tuple[float, float]:
    """RMS of what a formula changes around a cubic, at two strengths, as a share of the largest output; NaN where its
    answer is not (samples,) finite numbers."""
    time = lock(np.arange(SAMPLES) * (DURATION / SAMPLES))
    drive = lock(np.sin(2.0 * np.pi * time) * (1.0 - 0.2 * time))
    temperature = lock(22.0 + 9.0 * np.sin(2.0 * np.pi * time / (1.3 * DURATION)))
    top = float(_cubic(np.ones(1))[0])
    found = []
    for strength in STRENGTHS:
        random = (0.7, 0.2, 0.4)
        step = DURATION / SAMPLES
        given = Hiding(strength, random, time, drive, temperature, step, DURATION, FASTEST, 1.0, top)
        answer = form(_cubic, drive, given)
        shaped = np.shape(answer) == drive.shape
        found.append(float(np.sqrt(np.mean((answer - _cubic(drive)) ** 2))) / top if shaped else np.nan)
    return found[0], found[1]


def _cubic(u: Array) -> Array:
    bent: Array = 1.3 * u + 0.4 * u**3
    return bent

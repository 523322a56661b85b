"""The grid on which values lie: a converter's, an encoder's, or a file's rounding."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array

SHARE, STEPS, COARSEST = 0.1, 2, 8
"""Of the second differences of a rounded course, those that are not 0; their median, and its range, in steps of the
grid. Where a course goes by about one step or less from sample to sample, rounding makes most of them, of one step
each. What was made on a grid, such as stairs or ramps, has few of them, or larger ones, or two levels only. Of 59
records of measured devices, nine made ones with an encoder and six commands on a grid, half of STEPS changes one, a
fast sweep, whose rounding is heard without; twice of it, and half or twice of the others, change none."""


def grid_step(values: Array) -> float:
    """The step of the grid on which all values (samples,) lie, or 0."""
    levels = np.unique(values)
    steps = np.diff(levels)
    steps = steps[steps > 1e-9 * max(np.ptp(levels), np.finfo(float).tiny)]
    if steps.size < 2:
        return float(steps[0]) if steps.size else 0.0
    step = float(np.min(steps))
    multiples = steps / step
    return step if np.all(np.abs(multiples - np.rint(multiples)) < 0.05) else 0.0


def rounded_to(values: Array) -> float:
    """The step of the grid to which a slow course (samples,) was rounded, or 0: where none shows, or it was made so."""
    step = grid_step(values)
    if step == 0.0 or np.ptp(values) < COARSEST * step:
        return 0.0
    bends = np.rint(np.abs(np.diff(values, 2)) / step)
    bent = bends[bends > 0.0]
    return step if bent.size > SHARE * bends.size and np.median(bent) <= STEPS else 0.0

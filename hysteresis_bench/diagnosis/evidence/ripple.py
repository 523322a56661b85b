"""Does a residual repeat itself along the input, or along the output? So do the errors of gears, of encoders and of
interferometers [1], and the cogging of motors: once a tooth, a line or a fringe, whatever the time.

[1] P. L. M. Heydemann, Appl. Opt. 20 (1981) 3382.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.autocorrelated import FTest, constants, f_test, left_over
from hysteresis_bench.diagnosis.evidence.spectrum import largest_of

LEAST, MOST = 5.0, 128.0
"""Cycles over the range that are looked for: fewer are a smooth curve's."""

DEGREE = 4
"""Of the smooth curve that is no ripple."""

SAMPLES = 4.0
"""A cycle, at least, at the median speed."""

PROMINENT = 2.0
"""Times the power at all lower frequencies down to half of its own, at least: the spectrum of a smooth fault falls, and
has no line. With half and with twice of it the same was told of 162 made residuals: a ripple of all 18 that had one,
and of no other."""

BINS = 1024
WIDTH = 3
"""Half-cycles from a line within which its own power lies."""


@dataclass(frozen=True)
class Ripple:
    """test : of the largest line, p over all that were looked at
    cycles : of it, over the range;  0 where there is no line
    """

    test: FTest
    cycles: float


def ripple(residuals: Sequence[Array], courses: Sequence[Array]) -> Ripple | None:
    """The clearest one; None where the samples lie too far apart for any.

    residuals : (samples,) a record;  courses : of what it may repeat itself along, as long
    """
    joined = np.concatenate(list(courses))
    low, span = float(joined.min()), float(np.ptp(joined))
    steps = np.abs(np.concatenate([np.diff(course) for course in courses]))
    if span <= 0.0 or not steps.any():
        return None
    fastest = min(MOST, span / (SAMPLES * float(np.median(steps[steps > 0.0]))))
    if fastest < 2.0 * LEAST:
        return None
    x = [(course - low) / span for course in courses]
    smooth = [legvander(2.0 * part - 1.0, DEGREE)[:, 1:] for part in x]
    left = left_over(
        np.concatenate(list(residuals)), np.column_stack([np.concatenate(constants(x)), np.vstack(smooth)])
    )
    binned = np.bincount((np.concatenate(x) * (BINS - 1)).astype(int), left, BINS)
    power = np.abs(np.fft.rfft(binned, 2 * BINS)) ** 2  # at every half of a cycle
    halves = np.arange(int(2 * LEAST), int(2 * fastest) + 1)
    lines = [k for k in halves if power[k] > PROMINENT * power[k // 2 : k - WIDTH + 1].max()]
    if not lines:
        return Ripple(FTest(0.0, 1.0, 0.0), 0.0)
    largest = max(lines, key=lambda k: float(power[k]))
    angles = [np.pi * largest * part for part in x]
    found = f_test(residuals, [np.column_stack([np.sin(part), np.cos(part)]) for part in angles], smooth)
    return Ripple(FTest(found.statistic, largest_of(halves.size, found.p), found.share), largest / 2.0)

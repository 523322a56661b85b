"""Does a residual repeat itself along the input, or along the output? So do the errors of gears, of encoders and of
interferometers [1], and the cogging of motors.

[1] P. L. M. Heydemann, Appl. Opt. 20 (1981) 3382.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.autocorrelated import FTest, f_test, left_over
from hysteresis_bench.diagnosis.evidence.spectrum import largest_of
from hysteresis_bench.kernels import periodicity


@dataclass(frozen=True)
class Ripple:
    """test : of the largest line, p over all that were looked at
    cycles : of it, over the range;  0 where there is no line
    """

    test: FTest
    cycles: float


def ripple(residuals: Sequence[Array], courses: Sequence[Array], steps: Sequence[float]) -> Ripple | None:
    """The clearest one; None where the samples lie too far apart for any.

    residuals : (samples,) a record;  courses : of what it may repeat itself along, as long
    steps : to which a converter rounds each of the courses, 0 where it does not: with such a period its error repeats
        itself, and is none of the device's
    """
    rounding = [_wave(course / (step or np.inf)) for course, step in zip(courses, steps, strict=True)]
    found = periodicity.lines(courses, [left_over(*part) for part in zip(residuals, rounding, strict=True)])
    if found is None:
        return None
    if not found.cycles.size:
        return Ripple(FTest(0.0, 1.0, 0.0), 0.0)
    clearest, low, span = float(found.cycles[0]), min(course.min() for course in courses), periodicity.span(courses)
    x = [(course - low) / span for course in courses]
    smooth = [legvander(2.0 * part - 1.0, periodicity.DEGREE)[:, 1:] for part in x]
    beside = [np.column_stack(part) for part in zip(smooth, rounding, strict=True)]
    test = f_test(residuals, [_wave(clearest * part) for part in x], beside)
    return Ripple(FTest(test.statistic, largest_of(found.looked_at, test.p), test.share), clearest)


def _wave(cycles: Array) -> Array:
    """Columns (samples, 2)."""
    return np.column_stack([np.sin(2.0 * np.pi * cycles), np.cos(2.0 * np.pi * cycles)])

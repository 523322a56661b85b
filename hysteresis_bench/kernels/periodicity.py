"""What repeats itself along a course, the input or the output, once a tooth, a line or a fringe, whatever the time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander

from hysteresis_bench.arrays import Array

LEAST, MOST = 5.0, 128.0
"""Cycles over the range that are looked for: fewer are a smooth curve's."""

SAMPLES = 2.5
"""Values of the course a cycle, at least, taken in whatever order; two are the least that tell a frequency."""

RESOLVED = 0.9
"""Share of the range in which neighbouring values have to lie that close to each other.

Of 300 ripples of 6 to 40 cycles in white noise, on drives of 4 to 40 samples a cycle, the test of ripples finds 284 at
their period and 1 at another, and 2 in 300 residuals without one (level 0.01). With half of `SAMPLES` 295, 1 and 2,
with twice 241, 4 and 2; with half of the share that may be left 271, 5 and 2, with twice 291, 0 and 1."""

STEP = 0.25
"""Cycles from one frequency that is looked at to the next: half of the distance at which two are independent."""

DEGREE = 4
"""Of the smooth curve of the course that is taken out of residuals first, as it is no ripple."""

PROMINENT = 2.0
"""Times the gain at all lower frequencies down to half of its own, at least: what a smooth fault leaves falls, and has
no line. Of 162 made residuals, looked at by their Fourier spectrum, half and twice of it told the same: a ripple of all
18 that had one, and of no other. Without it an output that is cut off had an error of its sensor beside the saturation.
"""

ASIDE = 1.5
"""Cycles from a line within which its own power lies."""

BINS = 1024


@dataclass(frozen=True)
class Lines:
    """The prominent frequencies of residuals along a course, the clearest first.

    cycles : (lines,) of each over the range of the course
    gains : (lines,) by how much a wave at it lowers the sum of squares of `left`
    looked_at : independent frequencies that a line could have had
    left : (samples,) the residuals of all records, less a constant a record and a smooth curve of the course
    """

    cycles: Array
    gains: Array
    looked_at: int
    left: Array


def lines(courses: Sequence[Array], residuals: Sequence[Array], slopes: Sequence[Array] | None = None) -> Lines | None:
    """None where the samples lie too far apart for twice the fewest cycles.

    courses, residuals : (samples,) a record;  slopes : of the residual over what repeats itself, 1 where not given
    """
    most = resolved(courses)
    if most < 2.0 * LEAST:
        return None
    course = np.concatenate(list(courses))
    x = (course - course.min()) / span(courses)
    weight = np.ones(x.size) if slopes is None else np.concatenate(list(slopes))
    left = _without_smooth(np.concatenate(list(residuals)), x, [one.size for one in courses])
    cycles = np.arange(0.5 * LEAST, most, STEP)
    place = np.minimum((x * BINS).astype(int), BINS - 1)
    count, total = np.bincount(place, weight * weight, BINS), np.bincount(place, weight * left, BINS)
    gains = _gains(cycles, count, total)
    prominent = [k for k in range(cycles.size) if cycles[k] >= LEAST and _stands_out(cycles, gains, k)]
    ranked = sorted(prominent, key=lambda k: -float(gains[k]))
    looked_at = int(2.0 * STEP * np.count_nonzero(cycles >= LEAST)) + 1
    return Lines(cycles[ranked], gains[ranked], looked_at, left)


def span(courses: Sequence[Array]) -> float:
    """From the lowest to the highest of all records."""
    return float(max(course.max() for course in courses) - min(course.min() for course in courses))


def resolved(courses: Sequence[Array]) -> float:
    """Cycles over the range that the samples resolve, `MOST` at the most; 0 where nothing moves.

    A cycle that is passed between two samples is seen all the same where other passes take other values within it.
    """
    gaps = np.sort(np.diff(np.unique(np.concatenate(list(courses)))))
    if not gaps.size:
        return 0.0
    within = np.cumsum(gaps)
    widest = float(gaps[np.searchsorted(within, RESOLVED * within[-1])])
    return min(MOST, span(courses) / (SAMPLES * widest))


def _without_smooth(left: Array, x: Array, sizes: Sequence[int]) -> Array:
    """x : 0 to 1"""
    owner = np.repeat(np.arange(len(sizes)), sizes)
    smooth = np.column_stack([owner[:, None] == np.arange(len(sizes)), legvander(2.0 * x - 1.0, DEGREE)[:, 1:]])
    followed: Array = smooth @ np.linalg.lstsq(smooth, left, rcond=None)[0]
    return left - followed


def _gains(cycles: Array, count: Array, total: Array) -> Array:
    """By how much a wave at each frequency lowers the sum of squares;  count, total : (bins,) as in `lines`"""
    turns = 2.0 * np.pi * np.outer(cycles, (np.arange(BINS) + 0.5) / BINS)
    sine, cosine = np.sin(turns), np.cos(turns)
    ss, cc, sc = (sine * sine) @ count, (cosine * cosine) @ count, (sine * cosine) @ count
    s, c = sine @ total, cosine @ total
    gain: Array = (s * s * cc - 2.0 * s * c * sc + c * c * ss) / np.maximum(ss * cc - sc * sc, 1e-9 * (ss + cc) ** 2)
    return gain


def _stands_out(cycles: Array, gains: Array, k: int) -> bool:
    lower = gains[(cycles >= 0.5 * cycles[k]) & (cycles <= cycles[k] - ASIDE)]
    return bool(gains[k] > PROMINENT * lower.max())

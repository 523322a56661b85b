"""What repeats itself along a course, the input or the output, once a tooth, a line or a fringe, whatever the time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial.legendre import legvander

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Hiding
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record
from hysteresis_plugins.effects._ranges import motionless

LEAST, MOST = 5.0, 128.0
"""Cycles over the range that are searched: fewer are a smooth curve's."""

SAMPLES = 4.0
"""A cycle, at least, at the median speed."""

DEGREE = 4
"""Of the smooth curve of the course that is taken out of residuals first, as it is no ripple."""

PROMINENT = 2.0
"""Times the gain at all lower frequencies down to half of its own, at least: what a smooth fault leaves falls, and has
no line. Without it an output that is cut off had an error of its sensor beside the saturation."""

CHANCE = 0.05
"""Of a line in white noise, over all that are looked at."""

BINS = 1024
APART = 2.0
"""Cycles over the range between two proposals."""

AMPLITUDES = ("sine", "cosine")

MOST_SECOND = 0.7
"""Of the first harmonic, the second one's two parts, which is then the smaller: else each ripple has a fit of twice its
period, with next to no first harmonic."""


def parameters(unit: str, course: str) -> tuple[Parameter, ...]:
    """unit : of what is added;  course : unit of the course"""
    most, over = MOST_SECOND, "second harmonic over the first"
    return (
        Parameter("sine", -1.0, 1.0, unit, null=0.0, meaning="amplitude"),
        Parameter("cosine", -1.0, 1.0, unit, null=0.0, meaning="amplitude a quarter of a period earlier"),
        Parameter("second", -most, most, meaning=f"{over}, in phase"),
        Parameter("second_aside", -most, most, meaning=f"{over}, a quarter of its period earlier"),
        Parameter("period", 0.01, 1.0, course, "log", meaning="after which it repeats itself", positive=True),
    )


def hidden_periods(hiding: Hiding) -> float:
    """Six to fourteen, from the lowest to the highest."""
    return 6.0 + 8.0 * hiding.random[0]


def hidden(course: Array, largest: float, hiding: Hiding) -> Array:
    """w = 2 pi course / period of made data;  largest : of the course, to either side"""
    return np.asarray(np.pi * hidden_periods(hiding) * course / largest + 2.0 * np.pi * hiding.random[1])


def waves(p: Any) -> Array:
    """The amplitudes of sin w, cos w, sin 2 w and cos 2 w, (4, columns), w = 2 pi course / period.

    What is added is sine s + cosine c, s = sin w + second sin 2 w + second_aside cos 2 w, c the same a quarter of a
    period of either harmonic earlier.
    """
    twice = p.sine * p.second - p.cosine * p.second_aside, p.sine * p.second_aside + p.cosine * p.second
    return np.stack([p.sine, p.cosine, *twice])


def box(own: tuple[Parameter, ...], courses: Sequence[Array], most: float) -> tuple[Parameter, ...]:
    """From `LEAST` periods over the range of the course to as many as its samples resolve; amplitudes up to `most`."""
    sine, cosine, *shares, period = own
    span = _span(courses) or 1.0
    finest = max(_resolved(courses), 2.0 * LEAST)
    return (
        sine.within(-most, most),
        cosine.within(-most, most),
        *shares,
        period.within(span / finest, span / LEAST),
    )


def inapplicable(records: Sequence[Record], courses: Sequence[Array]) -> str:
    if reason := motionless(records):
        return reason
    if _resolved(courses) < 2.0 * LEAST:
        return f"the samples lie too far apart for {2.0 * LEAST:.0f} periods over the range"
    return ""


def proposals(
    courses: Sequence[Array], residuals: Sequence[Array], slopes: Sequence[Array] | None = None
) -> list[dict[str, float]] | None:
    """Values from which to fit: the highest lines of the residuals along the course, two at the most; None without one.

    courses, residuals : (scored samples,) a record;  slopes : of the residual over what is added, 1 where not given
    """
    course, span = np.concatenate(list(courses)), _span(courses)
    cycles = np.arange(0.5 * LEAST, _resolved(courses), 0.25)
    if not cycles.size or cycles[-1] < LEAST:
        return None
    x = (course - course.min()) / span
    weight = np.ones(x.size) if slopes is None else np.concatenate(list(slopes))
    left = _without_smooth(np.concatenate(list(residuals)), x, [one.size for one in courses])
    place = np.minimum((x * BINS).astype(int), BINS - 1)
    turns = 2.0 * np.pi * np.outer(cycles, (np.arange(BINS) + 0.5) / BINS)
    count, total = np.bincount(place, weight * weight, BINS), np.bincount(place, weight * left, BINS)
    gains = _gains(np.sin(turns), np.cos(turns), count, total)
    least = -2.0 * np.log(CHANCE / cycles.size) * float(np.mean(left**2))
    lines = [k for k in range(cycles.size) if gains[k] > least and _prominent(cycles, gains, k)]
    lines.sort(key=lambda k: -float(gains[k]))
    others = [k for k in lines[1:] if abs(cycles[k] - cycles[lines[0]]) >= APART]
    return [_amplitudes(course, left, weight, span / cycles[k]) for k in (*lines[:1], *others[:1])] or None


def _prominent(cycles: Array, gains: Array, k: int) -> bool:
    lower = gains[(cycles >= 0.5 * cycles[k]) & (cycles <= cycles[k] - 0.75 * APART)]
    return bool(cycles[k] >= LEAST and gains[k] > PROMINENT * lower.max())


def _without_smooth(left: Array, x: Array, sizes: Sequence[int]) -> Array:
    """Residuals less a constant a record and a smooth curve of the course;  x : 0 to 1"""
    owner = np.repeat(np.arange(len(sizes)), sizes)
    smooth = np.column_stack([owner[:, None] == np.arange(len(sizes)), legvander(2.0 * x - 1.0, DEGREE)[:, 1:]])
    followed: Array = smooth @ np.linalg.lstsq(smooth, left, rcond=None)[0]
    return left - followed


def _gains(sine: Array, cosine: Array, count: Array, total: Array) -> Array:
    """By how much a wave at each frequency, (frequencies, bins), lowers the sum of squares."""
    ss, cc, sc = (sine * sine) @ count, (cosine * cosine) @ count, (sine * cosine) @ count
    s, c = sine @ total, cosine @ total
    gain: Array = (s * s * cc - 2.0 * s * c * sc + c * c * ss) / np.maximum(ss * cc - sc * sc, 1e-9 * (ss + cc) ** 2)
    return gain


def _amplitudes(course: Array, left: Array, weight: Array, period: float) -> dict[str, float]:
    turn = 2.0 * np.pi * course / period
    columns = np.column_stack([np.sin(turn), np.cos(turn), np.sin(2.0 * turn), np.cos(2.0 * turn)])
    found = np.linalg.lstsq(weight[:, None] * columns, left, rcond=None)[0]
    first, second = complex(found[0], found[1]), complex(found[2], found[3])
    share = second / first if first else 0j
    share *= min(1.0, MOST_SECOND / max(abs(share), MOST_SECOND))
    return {
        "sine": first.real,
        "cosine": first.imag,
        "second": share.real,
        "second_aside": share.imag,
        "period": period,
    }


def _span(courses: Sequence[Array]) -> float:
    return float(max(course.max() for course in courses) - min(course.min() for course in courses))


def _resolved(courses: Sequence[Array]) -> float:
    """Cycles over the range that the samples resolve, `MOST` at the most; 0 where nothing moves."""
    steps = np.abs(np.concatenate([np.diff(course) for course in courses]))
    moving = steps[steps > 0.0]
    return min(MOST, _span(courses) / (SAMPLES * float(np.median(moving)))) if moving.size else 0.0

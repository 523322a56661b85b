"""What repeats itself along a course, the input or the output, once a tooth, a line or a fringe, whatever the time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Hiding
from hysteresis_bench.kernels import periodicity
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record
from hysteresis_plugins.effects._ranges import motionless

CHANCE = 0.05
"""Of a line in white noise, over all that are looked at."""

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
    """From the fewest periods over the range of the course to what its samples resolve; amplitudes up to `most`."""
    sine, cosine, *shares, period = own
    span = periodicity.span(courses) or 1.0
    finest = max(periodicity.resolved(courses), 2.0 * periodicity.LEAST)
    return (
        sine.within(-most, most),
        cosine.within(-most, most),
        *shares,
        period.within(span / finest, span / periodicity.LEAST),
    )


def inapplicable(records: Sequence[Record], courses: Sequence[Array]) -> str:
    if reason := motionless(records):
        return reason
    if periodicity.resolved(courses) < 2.0 * periodicity.LEAST:
        return f"the samples lie too far apart for {2.0 * periodicity.LEAST:.0f} periods over the range"
    return ""


def proposals(
    courses: Sequence[Array], residuals: Sequence[Array], slopes: Sequence[Array] | None = None
) -> list[dict[str, float]] | None:
    """Values from which to fit: the highest lines of the residuals along the course, two at the most; None without one.

    courses, residuals : (scored samples,) a record;  slopes : of the residual over what is added, 1 where not given
    """
    found = periodicity.lines(courses, residuals, slopes)
    if found is None:
        return None
    least = -2.0 * np.log(CHANCE / found.looked_at) * float(np.mean(found.left**2))
    clear = found.cycles[found.gains > least]
    course, span = np.concatenate(list(courses)), periodicity.span(courses)
    weight = np.ones(course.size) if slopes is None else np.concatenate(list(slopes))
    others = clear[np.abs(clear - clear[:1]) >= APART]
    return [_amplitudes(course, found.left, weight, span / cycles) for cycles in (*clear[:1], *others[:1])] or None


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

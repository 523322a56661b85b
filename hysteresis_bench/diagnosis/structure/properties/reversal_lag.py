"""Reversal lag: does the output turn later than the input?"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.noise_floor import FINEST
from hysteresis_bench.diagnosis.structure.cells import MOST
from hysteresis_bench.diagnosis.structure.course import Course
from hysteresis_bench.diagnosis.structure.curves import Curve
from hysteresis_bench.diagnosis.structure.finding import LEVEL, Finding

AROUND = 0.35
"""Share of the shorter of two branches, in samples, that is looked at on either side of a reversal."""
FEWEST, WIDEST = 8, 60
"""Samples on either side of a reversal: at least, at most."""
LATEST = 0.6
"""Longest lag, in samples on either side."""
STEPS = 25
BENDS = (0.02, 0.05, 0.1, 0.2, 0.4)
"""Ways along which a force turns over, as shares of the way that is looked at."""


def reversal_lag(course: Course) -> Finding:
    """One delay for all reversals against none, and against what needs no time: a clearance, a path that is gone
    without an answer, or a force that turns over along a short way."""
    from scipy.special import fdtrc

    if not all(view.record.timed for view in course.views):
        return Finding("reversal lag", "Time is only an index here: a lag cannot be told.")
    windows = _windows(course)
    if not windows:
        return Finding("reversal lag", "No reversal has enough samples on either side: a lag cannot be told.")
    half = (windows[0].stop - windows[0].start) // 2
    step = float(np.median([view.step for view in course.views]))
    none, degrees = _left(course, windows, _as_it_is)
    lags = np.linspace(0.0, LATEST * half, STEPS)[1:]
    late = np.array([_left(course, windows, _delayed(lag))[0] for lag in lags])
    reach = max(float(np.ptp(course_u(course)[window])) for window in windows)
    gaps = np.linspace(0.0, reach, STEPS)[1:]
    loose = min(_left(course, windows, _cleared(gap))[0] for gap in gaps)
    bends = min(_left(course, windows, _as_it_is, bend)[0] for bend in BENDS)
    best = int(np.argmin(late))
    floor = degrees * ((course.span_y * FINEST) ** 2 + sum(course.noise.variances))
    gain = min(none, loose, bends) - late[best]
    slow = sum(v * (1.0 + d) / (1.0 - d) for d, v in zip(course.noise.decays, course.noise.variances, strict=True))
    unit = max(late[best], floor) / degrees * max(slow / max(sum(course.noise.variances), 1e-300), 1.0)
    p = float(fdtrc(1.0, max(degrees, 4), max(gain, 0.0) / unit))
    lag = float(lags[best]) * step if p < LEVEL else 0.0
    moved = 100.0 * np.sqrt(max(gain, 0.0) / sum(window.stop - window.start for window in windows)) / course.span_y
    if p < LEVEL:
        words = (
            f"the output turns {lag:.2g} later than the input, which is {moved:.2g} % of the range (RMS) about the "
            "reversals: a delay or a lag stands around the law. Remove it before the law is judged."
        )
    else:
        words = f"the output turns with the input (p = {p:.2g}): no lag is needed."
    curves = _pictured(course, windows, step)
    return Finding("reversal lag", words, float(moved), p, curves=curves, along="time since the reversal")


def _pictured(course: Course, windows: list[slice], step: float) -> tuple[Curve, ...]:
    """Input and output about the mean reversal, turned upwards, each over its range there."""
    u, half = course_u(course), (windows[0].stop - windows[0].start) // 2
    way = [np.sign(u[window][half] - u[window][0]) for window in windows]
    time = step * np.arange(-half, half + 1)
    parts = {"input": u, "output": course.y}
    return tuple(Curve(time, _mean(values, windows, way), name=name) for name, values in parts.items())


def _mean(values: Array, windows: list[slice], way: list[float]) -> Array:
    moved = np.mean([sign * values[window] for sign, window in zip(way, windows, strict=True)], axis=0)
    shares: Array = (moved - moved.min()) / (np.ptp(moved) or 1.0)
    return shares


def course_u(course: Course) -> Array:
    """Inputs of all records, (samples,)."""
    return np.concatenate([view.u for view in course.views])


def _windows(course: Course) -> list[slice]:
    """Samples about the reversals, as many for each."""
    pairs = [
        (one, other)
        for one, other in zip(course.branches[:-1], course.branches[1:], strict=True)
        if one.record == other.record and other.order == one.order + 1
    ]
    sizes = [int(AROUND * min(one.u.size, other.u.size)) for one, other in pairs]
    long = [size for size in sizes if size >= FEWEST]
    if not long:
        return []
    half = int(min(np.median(long), WIDEST))
    middles = [
        int(other.samples[0]) for (one, other), size in zip(pairs, sizes, strict=True) if min(size, WIDEST) >= half
    ]
    return [slice(middle - half, middle + half + 1) for middle in middles[:: max(1, -(-len(middles) // MOST))]]


Change = Callable[[Array, int], tuple[Array, int]]
"""The input about a reversal, (samples,), and the sample of the reversal -> as the law sees them."""


def _as_it_is(u: Array, turn: int) -> tuple[Array, int]:
    return u, turn


def _delayed(lag: float) -> Change:
    def change(u: Array, turn: int) -> tuple[Array, int]:
        samples = np.arange(u.size)
        return np.interp(samples - lag, samples, u), round(turn + lag)

    return change


def _cleared(gap: float) -> Change:
    def change(u: Array, turn: int) -> tuple[Array, int]:
        far = np.abs(u - u[turn])
        after = np.arange(u.size) > turn
        sign = np.sign(u[-1] - u[turn])
        return np.where(after, u[turn] + sign * np.maximum(far - gap, 0.0), u), turn

    return change


def _left(course: Course, windows: list[slice], change: Change, bend: float | None = None) -> tuple[float, int]:
    """Sum of squares that a curve of the input before and one after the turn leave, and its degrees of freedom.

    bend : way along which the output turns over after it, as a share of the window's
    """
    u, y = course_u(course), course.y
    total, degrees = 0.0, 0
    for window in windows:
        half = (window.stop - window.start) // 2
        seen, turn = change(u[window], half)
        turn = min(turn, seen.size - 4)
        x = (seen - seen[turn]) / (np.ptp(seen) or 1.0)
        before = (np.arange(x.size) <= turn).astype(float)
        columns = np.column_stack([np.ones_like(x), *(part * x**k for part in (before, 1.0 - before) for k in (1, 2))])
        if bend is not None:
            columns = np.column_stack([columns, (1.0 - before) * np.expm1(-np.abs(x) / bend)])
        start = half // 2  # a delayed input is not known at the window's beginning
        kept, target = columns[start:], y[window][start:]
        solution, _, rank, _ = np.linalg.lstsq(kept, target, rcond=1e-9)
        total += float(np.sum((target - kept @ solution) ** 2))
        degrees += target.size - int(rank)
    return total, degrees

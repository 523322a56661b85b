"""Sense: do the loops run clockwise or anticlockwise, output over input?"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.curves import measured
from hysteresis_bench.diagnosis.structure.finding import LEVEL, Finding

THIN = 2e-3
"""Share of the rectangle around a loop below which its area says nothing."""
CLOSED = 0.02
"""Share of its input's range by which a record may end away from where it began, to be one loop."""
FEWEST = 12
"""Samples of such a loop."""
MOST = 24
"""Loops of a record that are looked at."""
MOST_SHOWN = 4
"""Records in the picture."""
COARSE = 0.3
"""A step of the input beyond this share of its range leaves out a branch."""


def sense(course: Course) -> Finding:
    """The sign of the area that the loops of every record enclose, over the rectangle around them."""
    from scipy.special import ndtr

    areas, errors, records = [], [], []
    for number in range(len(course.views)):
        rows = [row for _, _, row in loops(course, number)]
        if rows:
            whole = np.sum(rows, axis=0)
            areas.append(float(whole @ course.y) / len(rows))
            errors.append(float(np.sqrt(course.noise.covariance(whole[None])[0, 0])) / len(rows))
            records.append(course.views[number].record.name)
    if not areas:
        return Finding("sense", "No loop closes: its sense cannot be told.")
    box = course.span_u * course.span_y
    slack = THIN * box
    z = [abs(area) / np.hypot(error, slack) for area, error in zip(areas, errors, strict=True)]
    signs = [int(np.sign(area)) if 2.0 * ndtr(-one) < LEVEL else 0 for area, one in zip(areas, z, strict=True)]
    strongest = int(np.argmax(z))
    p, share = float(2.0 * ndtr(-z[strongest])), 100.0 * areas[strongest] / box
    mixed = {-1, 1} <= {*signs}
    words = _words(signs, records, share, p)
    return Finding(
        "sense",
        words,
        share,
        p,
        mixed=mixed,
        curves=tuple(measured(view.u, view.y) for view in course.views[:MOST_SHOWN]),
        along="input",
    )


def _words(signs: list[int], records: list[str], share: float, p: float) -> str:
    clockwise, other = ([name for name, sign in zip(records, signs, strict=True) if sign == one] for one in (-1, 1))
    if clockwise and other:
        return (
            f"loops run clockwise in {_some(clockwise)} and anticlockwise in {_some(other)}: no law with one set of "
            "parameters follows both, unless its loops cross."
        )
    if not clockwise and not other:
        return f"the loops enclose {abs(share):.2g} % of the rectangle around them (p = {p:.2g}): they have no sense."
    side = "clockwise, output over input, as a force over a displacement" if clockwise else "anticlockwise"
    return f"the loops run {side}, and enclose {abs(share):.2g} % of the rectangle around them."


def _some(names: list[str]) -> str:
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def loops(course: Course, number: int) -> list[tuple[float, float, Array]]:
    """Half the range, the duration, and the samples' weights that give the enclosed area, of every closed loop.

    A loop goes from the input's middle, rising, to the next time that it rises through the same value. Anticlockwise
    loops have positive areas; weights : (samples of all records,)
    """
    own = [branch for branch in course.branches if branch.record == number and branch.order]
    threes = [three for three in zip(own[:-2], own[1:-1], own[2:], strict=True) if _whole(course, *three)]
    found = []
    for up, down, next_up in threes[:: max(1, -(-len(threes) // MOST))]:
        row = _area(course, up, down, next_up)
        if row is not None:
            duration = float(down.time[-1] - up.time[0])
            found.append((0.5 * abs(down.start - next_up.start), duration, row))
    return found or _closed(course, number)


def _whole(course: Course, up: Branch, down: Branch, next_up: Branch) -> bool:
    follow = up.order + 2 == down.order + 1 == next_up.order
    return follow and up.way > 0 and not _coarse(course, np.concatenate([up.u, down.u]))


def _coarse(course: Course, u: Array) -> bool:
    return bool(np.max(np.abs(np.diff(u))) > COARSE * course.span_u)


def _closed(course: Course, number: int) -> list[tuple[float, float, Array]]:
    """The whole record, where it ends where it began."""
    view = course.views[number]
    u, span = view.u, float(np.ptp(view.u))
    if u.size < FEWEST or abs(u[-1] - u[0]) > CLOSED * span or span < 0.5 * course.span_u or _coarse(course, u):
        return []
    first = course.noise.borders[number]
    return [(0.5 * span, float(np.ptp(view.time)), _weights(course, np.arange(first, first + u.size), u))]


def _area(course: Course, up: Branch, down: Branch, next_up: Branch) -> Array | None:
    level = 0.5 * (down.start + next_up.start)
    first, last = np.flatnonzero(up.u >= level), np.flatnonzero(next_up.u >= level)
    if not (first.size and last.size and up.u[0] < level):
        return None
    samples = np.concatenate([up.samples[first[0] :], down.samples[1:], next_up.samples[1 : last[0] + 1]])
    u = np.concatenate([up.u[first[0] :], down.u[1:], next_up.u[1 : last[0] + 1]])
    return _weights(course, samples, u)


def _weights(course: Course, samples: Array, u: Array) -> Array:
    """Of the samples, in order around a loop, for the area that it encloses."""
    steps = np.diff(np.append(u, u[0]))
    row = np.zeros(course.y.size)
    row[samples] = -0.5 * (steps + np.roll(steps, 1))
    return row

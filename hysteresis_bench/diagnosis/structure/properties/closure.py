"""Closure: does a repeated cycle repeat the output? Drift, accommodation and relaxation do not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.alike import alike, mismatch
from hysteresis_bench.diagnosis.structure.cells import Cell, Unlike, evenly, places, read, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import LEVEL, Finding, told

SETTLED = 2
"""Branches at a record's start that have a memory of their own."""


def closure(course: Course) -> Finding:
    """Branches between the same reversals within one record, over and over: what changes from one to the next?"""
    own = [branch for branch in course.branches if branch.order >= SETTLED]
    groups = [group for group in alike(course, own, _cycle) if len(group) > 1]
    cells = [cell for number, group in enumerate(groups) for cell in _over(course, evenly(group, len(groups)), number)]
    found = unlike(course, cells, mismatch(course, groups, _cycle), repeats=0.0)
    why = _manner(found) if found is not None and found.p < LEVEL else ""
    return told(
        "closure",
        course,
        found,
        differ="repeated cycles differ by",
        why=why,
        without="No cycle of the input is repeated: whether the loop closes cannot be tested.",
        along="input",
    )


def _over(course: Course, branches: Sequence[Branch], number: int) -> list[Cell]:
    cells = []
    for branch in branches:
        for at in places(float(branch.u.min()), float(branch.u.max()), course.field).tolist():
            weights = read(branch, branch.u, at, course.field)
            if weights is not None:
                cells.append(Cell(branch, weights, (number, round(at / course.field, 3)), None, at))
    return cells


def _cycle(branch: Branch) -> tuple[float, ...]:
    """Record, direction and reversals, each of the size of an input."""
    far = 1e6 * (1.0 + max(abs(value) for value in branch.past))
    return (branch.record * far, branch.way * far, *branch.past[:2])


def _manner(found: Unlike) -> str:
    """Does the level move steadily in time, or with its logarithm, or settle?"""
    times, levels = _levels(found)
    if times.size < 3:
        return "the device drifts, creeps or accommodates; no law without time or path in it does"
    share = [_explained(clock, levels) for clock in (times, np.log(times))]
    manner = "steadily in time: drift" if share[0] >= share[1] else "with the logarithm of time: creep or accommodation"
    if max(share) < 0.5:
        return "without a trend in time; something beside the input acts, or the shape of the loop changes"
    return f"{manner}; no law without time or path in it does that"


def _levels(found: Unlike) -> tuple[Array, Array]:
    """When each branch ran since the first of its record (at least a branch's time), and by how much it lies off."""
    groups: dict[int, tuple[Branch, list[float]]] = {}
    for cell, left in zip(found.cells, found.left, strict=True):
        groups.setdefault(id(cell.branch), (cell.branch, []))[1].append(float(left))
    times = np.array([float(np.mean(branch.time)) for branch, _ in groups.values()])
    levels = np.array([float(np.mean(parts)) for _, parts in groups.values()])
    shortest = min(float(np.ptp(branch.time)) for branch, _ in groups.values())
    return times - times.min() + shortest, levels


def _explained(clock: Array, levels: Array) -> float:
    """Share of the levels' variance."""
    if np.ptp(levels) == 0.0 or np.ptp(clock) == 0.0:
        return 0.0
    return float(np.corrcoef(clock, levels)[0, 1] ** 2)

"""Closure: does a repeated cycle repeat the output? Drift, accommodation and relaxation do not."""

from __future__ import annotations

from collections.abc import Hashable

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.alike import alike, mismatch, remembered
from hysteresis_bench.diagnosis.structure.cells import Cell, Unlike, along, evenly, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import LEVEL, Finding, told

CLEAR = 0.5
"""Share of the branches' levels that a trend must explain."""
SETTLED = 2
"""Branches at a record's start that have a memory of their own."""


def closure(course: Course) -> Finding:
    """Branches between the same reversals within one record, over and over: what changes from one to the next?"""
    own = [branch for branch in course.branches if branch.order >= SETTLED]
    groups = [group for group in alike(course, own, _cycle) if len(group) > 1]
    cells: list[Cell] = []
    for number, group in enumerate(groups):
        for branch in evenly(group, len(groups)):
            cells += along(course, branch, branch.u, (float(branch.u.min()), float(branch.u.max())), group=number)
    found = unlike(course, cells, mismatch(course, groups, _cycle), repeats=0.0)
    why = _manner(course, found) if found is not None and found.p < LEVEL else ""
    return told(
        "closure",
        course,
        found,
        differ="repeated cycles differ by",
        why=why,
        without="No cycle of the input is repeated: whether the loop closes cannot be tested.",
        along="input",
    )


def _cycle(branch: Branch) -> tuple[Hashable, tuple[float, ...]]:
    """The same history: between two equal ends minor loops lie elsewhere after another one."""
    past = remembered(branch)
    return (branch.record, branch.way, len(past)), past


def _manner(course: Course, found: Unlike) -> str:
    """Does the level move steadily in time, or with its logarithm, or settle?"""
    times, levels, groups = _levels(course, found)
    share = [_explained(clock, levels, groups) for clock in (times, np.log(times))]
    if max(share) < CLEAR:
        return "without a trend in time; something beside the input acts, or the shape of the loop changes"
    manner = "steadily in time: drift" if share[0] >= share[1] else "with the logarithm of time: creep or accommodation"
    return f"{manner}; no law without time or path in it does that"


def _levels(course: Course, found: Unlike) -> tuple[Array, Array, Array]:
    """When each branch ran since the first sample of its record, by how much it lies off, and what it repeats."""
    parts: dict[int, list[Cell]] = {}
    levels: dict[int, list[float]] = {}
    for cell, left in zip(found.cells, found.left, strict=True):
        parts.setdefault(id(cell.branch), []).append(cell)
        levels.setdefault(id(cell.branch), []).append(float(left))
    firsts = [own[0] for own in parts.values()]
    begun = [course.views[cell.branch.record].record.time[0] for cell in firsts]
    times = np.array([float(np.mean(cell.branch.time)) - first for cell, first in zip(firsts, begun, strict=True)])
    return times, np.array([float(np.mean(own)) for own in levels.values()]), np.array([cell.group for cell in firsts])


def _explained(clock: Array, levels: Array, groups: Array) -> float:
    """Share of the levels' variance within the groups that a line in the clock explains."""
    own = np.equal.outer(groups, np.unique(groups)).astype(float)
    within = [part - own @ np.linalg.lstsq(own, part, rcond=None)[0] for part in (clock, levels)]
    size = float(np.sqrt((within[0] @ within[0]) * (within[1] @ within[1])))
    return float(within[0] @ within[1] / size) ** 2 if size > 0.0 else 0.0

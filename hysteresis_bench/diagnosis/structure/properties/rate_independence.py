"""Rate independence: the same way at another speed gives the same output."""

from __future__ import annotations

from collections.abc import Hashable

from hysteresis_bench.diagnosis.structure.alike import alike, mismatch, remembered
from hysteresis_bench.diagnosis.structure.cells import Cell, Unlike, along, evenly, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import Finding, told

FASTER = 1.2
"""Ratio of speeds from which they count as different."""


def rate_independence(course: Course) -> Finding:
    """Branches with the same reversals before them, run at different speeds; each record has an offset."""
    untimed = not all(view.record.timed for view in course.views)
    return told(
        "rate independence",
        course,
        None if untimed else _found(course),
        differ="the same way at different speeds differs by",
        why="no law that is rate-independent follows it alone: a lag, creep or eddy currents around it may",
        without="Time is only an index here: speeds cannot be compared."
        if untimed
        else "The input takes no path at two speeds: rate independence cannot be tested.",
        along="input",
    )


def _found(course: Course) -> Unlike | None:
    groups = [group for group in alike(course, course.branches, _memory) if _speeds(group)]
    cells: list[Cell] = []
    for number, group in enumerate(groups):
        for branch in evenly(group, len(groups)):
            ends = (float(branch.u.min()), float(branch.u.max()))
            cells += along(course, branch, branch.u, ends, group=number, constant=branch.record)
    return unlike(course, cells, mismatch(course, groups, _memory))


def _speeds(group: list[Branch]) -> bool:
    speeds = [branch.speed for branch in group]
    return len(group) > 1 and max(speeds) > FASTER * min(speeds)


def _memory(branch: Branch) -> tuple[Hashable, tuple[float, ...]]:
    """As many reversals in all, too: a law may degrade along its way."""
    return (branch.way, branch.order), remembered(branch)

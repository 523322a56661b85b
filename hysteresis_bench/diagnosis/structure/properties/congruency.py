"""Congruency: minor loops between the same inputs are one curve, whatever came before.

[1] I. D. Mayergoyz, Phys. Rev. Lett. 56 (1986) 1518.
"""

from __future__ import annotations

from collections.abc import Hashable

import numpy as np

from hysteresis_bench.diagnosis.structure.alike import alike, mismatch
from hysteresis_bench.diagnosis.structure.cells import Cell, Unlike, along, evenly, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import Finding, told

APART = 0.02
"""Share of the output's range by which branches from one input must be shifted to have another history."""


def congruency(course: Course) -> Finding:
    """Branches from reversals at the same input, but at different outputs, within the depth of their memory."""
    return told(
        "congruency",
        course,
        _found(course),
        differ="minor loops from the same input and of different history differ by",
        why="no classical Preisach operator, nor any sum of plays, follows them",
        without="No two minor loops have the same ends and another history: congruency cannot be tested. Drive the "
        "input between the same two values once while rising and once while falling.",
        along="input",
    )


def _found(course: Course) -> Unlike | None:
    own = [branch for branch in course.branches if branch.order]
    groups = [group for group in alike(course, own, _start) if _shifted(course, group)]
    cells: list[Cell] = []
    for number, group in enumerate(groups):
        for branch in evenly(group, len(groups)):
            far = min(branch.depth, abs(float(branch.u[-1]) - branch.start))
            low, high = sorted((branch.start, branch.start + branch.way * far))
            cells += along(course, branch, branch.u, (low, high), group=number, constant=id(branch))
    return unlike(course, cells, mismatch(course, groups, _start))


def _shifted(course: Course, group: list[Branch]) -> bool:
    return len(group) > 1 and bool(np.ptp([branch.y[0] for branch in group]) > APART * course.span_y)


def _start(branch: Branch) -> tuple[Hashable, tuple[float, ...]]:
    return branch.way, (branch.start,)

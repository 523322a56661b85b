"""Odd symmetry: does the mirrored input give the mirrored output?"""

from __future__ import annotations

from collections.abc import Hashable

from hysteresis_bench.diagnosis.structure.alike import alike, mismatch, remembered
from hysteresis_bench.diagnosis.structure.cells import Cell, along, evenly, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import Finding, told


def odd_symmetry(course: Course) -> Finding:
    """Rising branches against falling ones whose last reversals are mirrored at the input 0; the output's centre
    is free. Within a record each: its speed is its own."""
    groups = [
        group
        for group in alike(course, [branch for branch in course.branches if branch.order], _mirrored)
        if {branch.way for branch in group} == {1, -1}
    ]
    cells: list[Cell] = []
    for number, group in enumerate(groups):
        for branch in evenly(group, len(groups)):
            u = branch.way * branch.u
            constant = (branch.record, branch.way)
            ends = (float(u.min()), float(u.max()))
            cells += along(course, branch, u, ends, group=number, constant=constant, sign=branch.way)
    return told(
        "odd symmetry",
        course,
        unlike(course, cells, mismatch(course, groups, _mirrored)),
        differ="branches and their mirror images differ by",
        why="no law that is odd in the input follows them; --input-offset moves the centre, the effect asymmetry "
        "bends the output",
        without="No two reversals are mirrored at the input 0: odd symmetry cannot be tested.",
        along="input times direction",
    )


def _mirrored(branch: Branch) -> tuple[Hashable, tuple[float, ...]]:
    past = remembered(branch)
    return (branch.record, len(past)), tuple(branch.way * value for value in past)

"""Rising against falling branches: is the loop its own image, turned about its centre, wherever that is?"""

from __future__ import annotations

from collections.abc import Hashable
from itertools import pairwise

from hysteresis_bench.diagnosis.structure.alike import alike, mismatch, remembered
from hysteresis_bench.diagnosis.structure.cells import Cell, evenly, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import Finding, told
from hysteresis_bench.diagnosis.structure.properties.masing import since_reversal


def rising_falling(course: Course) -> Finding:
    """Branches between the same two reversals, upwards and downwards, each from its own reversal on."""
    groups = [group for group in alike(course, course.branches[1:], _ends) if {b.way for b in group} == {1, -1}]
    cells: list[Cell] = []
    for number, group in enumerate(groups):
        cells += since_reversal(course, evenly([branch for branch in group if branch.order], len(groups)), number)
    return told(
        "rising and falling branches",
        course,
        unlike(course, cells, mismatch(course, groups, _ends)),
        differ="rising and falling branches between the same reversals differ by",
        why="the loop is no image of itself turned about its centre; no law of Masing's rule follows it, and no odd "
        "law where the input's centre is 0",
        without="The input never goes up and down between the same two reversals: rising branches cannot be held "
        "against falling ones.",
        along="way since the reversal",
    )


def _ends(branch: Branch) -> tuple[Hashable, tuple[float, ...]]:
    """Lower and upper reversal between which it runs, and how far the input went between those before."""
    past = remembered(branch)
    steps = [branch.way * (one - other) for one, other in pairwise(past)]
    return (branch.record, len(past)), (min(past[:2]), max(past[:2]), *steps)

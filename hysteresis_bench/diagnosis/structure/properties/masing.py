"""Masing's rule: from every reversal the same curve, as far as the memory of the reversal before reaches.

[1] G. Masing, Proc. 2nd Int. Congress of Applied Mechanics, Zürich (1926).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.diagnosis.structure.cells import Cell, Unlike, along, evenly, unlike
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.finding import Finding, told

APART = 0.05
"""Share of the input's range by which reversals must differ."""


def masing(course: Course) -> Finding:
    """Branches of one direction from reversals at different inputs: are they one curve, but for where they begin?"""
    return told(
        "Masing's rule",
        course,
        from_reversals(course),
        differ="branches from different reversals differ by",
        why="no law of Masing's rule follows them",
        without="No two branches of one direction begin at different inputs: Masing's rule cannot be tested. "
        "Let the input turn at several amplitudes.",
        along="way since the reversal",
    )


def from_reversals(course: Course) -> Unlike | None:
    """Branches of either direction, each compared with its own."""
    cells: list[Cell] = []
    for way in (1, -1):
        own = [branch for branch in course.branches if branch.way == way and branch.order]
        if own and np.ptp([branch.start for branch in own]) > APART * course.span_u:
            cells += since_reversal(course, evenly(own, 2), way)
    return unlike(course, cells)


def since_reversal(course: Course, branches: Sequence[Branch], group: int) -> list[Cell]:
    """Cells on the way since the reversal, within the depth of the memory; the first field holds the reversal."""
    return [
        cell
        for branch in branches
        for cell in along(
            course,
            branch,
            branch.way_back,
            (0.0, min(branch.depth, float(branch.way_back.max()))),
            group=group,
            constant=id(branch),
            sign=branch.way,
        )
    ]

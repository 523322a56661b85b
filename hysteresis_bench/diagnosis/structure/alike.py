"""Branches that began alike: the same reversals before them, as far back as asked."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.course import DEPTH, Branch, Course

MATCH = 0.005
"""Share of the input's range within which two reversals count as the same."""


def alike(course: Course, branches: Sequence[Branch], key: Callable[[Branch], Sequence[float]]) -> list[list[Branch]]:
    """Groups of branches whose keys (inputs) are the same; key : as many numbers for every branch"""
    groups: list[list[Branch]] = []
    keys: list[Array] = []
    for branch in branches:
        own = np.array(key(branch))
        for group, other in zip(groups, keys, strict=True):
            if np.all(np.abs(own - other) <= MATCH * course.span_u):
                group.append(branch)
                break
        else:
            groups.append([branch])
            keys.append(own)
    return groups


def mismatch(course: Course, groups: Sequence[Sequence[Branch]], key: Callable[[Branch], Sequence[float]]) -> float:
    """What unequal reversals make of the output: their RMS by the ratio of the ranges, unit of the output."""
    spread = [np.std([key(branch) for branch in group], axis=0) for group in groups if len(group) > 1]
    return float(np.sqrt(np.mean(np.square(spread)))) * course.span_y / course.span_u if spread else 0.0


def remembered(branch: Branch) -> tuple[float, ...]:
    """The reversals before it, at most DEPTH, nulls where there are fewer; and how many, of the size of an input."""
    known = branch.past[:DEPTH]
    return (*known, *(0.0,) * (DEPTH - len(known)), len(known) * apart(branch))


def apart(branch: Branch) -> float:
    """What keeps keys from being the same, where it is added to an input."""
    return 1e6 * (1.0 + max(abs(value) for value in branch.past))

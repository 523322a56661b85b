"""Branches that began alike: the same reversals before them, as far back as asked."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import TypeAlias

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.course import DEPTH, Branch, Course

MATCH = 0.005
"""Share of the input's range within which two reversals count as the same."""

Key: TypeAlias = Callable[[Branch], tuple[Hashable, Sequence[float]]]
"""A label, which must be the same, and inputs, which must nearly be; as many for every branch of a label."""


def alike(course: Course, branches: Sequence[Branch], key: Key) -> list[list[Branch]]:
    """Groups of branches whose keys are the same."""
    groups: list[list[Branch]] = []
    keys: list[tuple[Hashable, Array]] = []
    for branch in branches:
        label, inputs = key(branch)
        own = np.array(inputs)
        for group, (other, others) in zip(groups, keys, strict=True):
            if label == other and np.all(np.abs(own - others) <= MATCH * course.span_u):
                group.append(branch)
                break
        else:
            groups.append([branch])
            keys.append((label, own))
    return groups


def mismatch(course: Course, groups: Sequence[Sequence[Branch]], key: Key) -> float:
    """What unequal reversals make of the output: their RMS by the ratio of the ranges, unit of the output."""
    spread = [np.mean(np.var([key(branch)[1] for branch in group], axis=0)) for group in groups if len(group) > 1]
    return float(np.sqrt(np.mean(spread))) * course.span_y / course.span_u if spread else 0.0


def remembered(branch: Branch) -> tuple[float, ...]:
    """The reversals before it, the last first, at most DEPTH."""
    return branch.past[:DEPTH]

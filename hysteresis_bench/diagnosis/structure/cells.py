"""Curves read at places of the input, and whether those that a law says are equal differ by more than the noise.

A cell is the output of one branch at one place: the value there of a parabola through the samples of a field around
it, a linear function of the samples. The law says that cells of one label are equal, but for constants that it leaves
free; what is left of the best such curve is a sum of squares of linear functions of the noise, whose distribution
under the measured covariance is that of a chi-square variable of the same mean and variance [1].

[1] G. E. P. Box, Ann. Math. Stat. 25 (1954) 290.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.course import Branch, Course

FEWEST = 4
"""Samples of a cell."""
MOST = 24
"""Branches that a test looks at; of more, some are taken, evenly."""


@dataclass(frozen=True, eq=False)
class Cell:
    """weights : of its branch's samples, (samples,);  at : where, the input or the way since the reversal
    group : cells of one group at one place are what the law says is equal;  constant : what it leaves free, None where
    nothing;  sign : of the output
    """

    branch: Branch
    weights: Array
    at: float
    group: int
    constant: Hashable = None
    sign: int = 1

    @property
    def place(self) -> tuple[int, float]:
        return self.group, self.at


@dataclass(frozen=True, eq=False)
class Unlike:
    """rms : of what is left, and least : what of it is no noise, over all scored samples; unit of the output
    p : of noise alone leaving so much;  left : of every cell, (cells,);  cells : that could be compared
    """

    rms: float
    least: float
    p: float
    left: Array
    cells: tuple[Cell, ...]


def read(coordinate: Array, at: float, width: float) -> Array | None:
    """Weights of the samples that give the output where the coordinate is `at`, (samples,); None where there are too
    few samples, or only on one side."""
    distance = (coordinate - at) / (0.5 * width)
    inside = np.abs(distance) <= 1.0
    x = distance[inside]
    if x.size < FEWEST or x.min() > -0.5 or x.max() < 0.5 or np.max(np.diff(np.sort(x))) > 0.9:
        return None
    weights = np.zeros(coordinate.size)
    weights[inside] = np.linalg.pinv(np.column_stack([np.ones_like(x), x, x**2]))[0]
    return weights


def along(course: Course, branch: Branch, coordinate: Array, ends: tuple[float, float], **said: Any) -> Iterator[Cell]:
    """The cells of a branch whose fields lie within the ends. coordinate : (samples,);  said : of every cell"""
    for at in places(*ends, course.field).tolist():
        weights = read(coordinate, at, course.field)
        if weights is not None:
            yield Cell(branch, weights, at, **said)


def places(low: float, high: float, width: float) -> Array:
    """Centres of the fields that lie inside low to high, on a grid that all curves share, rounded as one."""
    centres: Array = np.round(np.arange(np.ceil(low / width), np.floor(high / width)) + 0.5, 1) * width
    return centres


def evenly(branches: Sequence[Branch], groups: int = 1) -> list[Branch]:
    """At most MOST of them, shared between so many groups of which this is one; but two."""
    most = max(2, MOST // groups)
    return [branches[k] for k in np.unique(np.linspace(0, len(branches) - 1, most).round().astype(int))]


def unlike(
    course: Course, cells: Sequence[Cell], tolerance: float = 0.0, repeats: float | None = None
) -> Unlike | None:
    """None where no two cells can be compared. tolerance : RMS beside the course's own;  repeats : how badly cycles
    repeat, the course's own where None; unit of the output"""
    cells = _comparable(cells)
    if len(cells) < 2:
        return None
    design = np.hstack([columns([cell.place for cell in cells]), columns([cell.constant for cell in cells])])
    basis, sizes, _ = np.linalg.svd(design, full_matrices=False)
    basis = basis[:, sizes > 1e-9 * sizes[0]]
    if basis.shape[1] >= len(cells):
        return None
    rows = np.zeros((len(cells), course.y.size))
    for row, cell in zip(rows, cells, strict=True):
        row[cell.branch.samples] += cell.sign * cell.weights
    rows -= basis @ (basis.T @ rows)
    left = rows @ course.y
    badly = course.repeats if repeats is None else repeats
    beside = (tolerance**2 + course.tolerance**2 + badly**2) * (len(cells) - basis.shape[1])
    p, excess = judged(course, rows, left, beside)
    covered = np.unique(np.concatenate([cell.branch.samples[cell.weights != 0.0] for cell in cells])).size
    least = float(np.sqrt(excess / len(cells) * covered / course.y.size))
    return Unlike(float(np.sqrt(np.mean(left**2))), least, p, left, tuple(cells))


def judged(course: Course, rows: Array, left: Array, beside: float) -> tuple[float, float]:
    """How probable so large a sum of squares is under the noise, and by how much it exceeds what is expected.

    rows : (functions, samples) of the output;  left : their values;  beside : expected beside the noise
    """
    from scipy.special import fdtrc

    covariance = course.noise.covariance(rows)
    mean, square = float(np.trace(covariance)), float(np.sum(covariance**2))
    total = float(left @ left)
    freedom = mean**2 / square if square > 0.0 else float(left.size)
    expected = mean + beside
    if expected <= 0.0:
        return (1.0, 0.0) if total == 0.0 else (0.0, total)
    return float(fdtrc(freedom, course.noise.freedom, total / expected)), max(total - expected, 0.0)


def _comparable(cells: Sequence[Cell]) -> list[Cell]:
    """Those at places where there is another one."""
    found = [cell.place for cell in cells]
    many = {place for place in set(found) if found.count(place) > 1}
    return [cell for cell in cells if cell.place in many]


def columns(labels: Sequence[Hashable]) -> Array:
    """A column of zeros and ones for every label but None."""
    known = {label: column for column, label in enumerate(dict.fromkeys(one for one in labels if one is not None))}
    columns = np.zeros((len(labels), len(known)))
    for row, label in zip(columns, labels, strict=True):
        if label is not None:
            row[known[label]] = 1.0
    return columns

"""What a structure test compares, as curves for a small picture: moved onto each other, and by how much they differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.csv_files import read_table, write_table
from hysteresis_bench.diagnosis.structure.cells import Unlike, columns
from hysteresis_bench.diagnosis.structure.course import Course

FILE = "structure.csv"
MOST = 8
"""Curves in a picture."""
DRAWN = 400
"""Points of a curve that is measured sample by sample."""
HEADER = ("test", "curve", "x", "y", "apart")


@dataclass(frozen=True, eq=False)
class Curve:
    """x, y : (points,);  apart : (points,) what it differs by from the curve that it should be, % of the output's
    range, empty where there is none;  name : of what it is, where curves are not alike
    """

    x: Array
    y: Array
    apart: Array = field(default_factory=lambda: np.empty(0))
    name: str = ""


class Pictured(Protocol):
    """What has curves that show it, as a structure test's finding has."""

    @property
    def name(self) -> str: ...

    @property
    def curves(self) -> tuple[Curve, ...]: ...


def compared(course: Course, found: Unlike) -> tuple[Curve, ...]:
    """Curves that should be equal, the constants that are free taken off; of many the most unlike ones."""
    cells = found.cells
    values = np.array([cell.sign * float(cell.weights @ cell.branch.y) for cell in cells])
    places, constants = columns([cell.place for cell in cells]), columns([cell.constant for cell in cells])
    solution = np.linalg.lstsq(np.hstack([places, constants]), values - found.left, rcond=None)[0]
    common: Array = places @ solution[: places.shape[1]]
    groups = np.array([cell.group for cell in cells])
    if constants.size:  # their level says nothing: every group begins at 0
        for group in np.unique(groups):
            rows = np.flatnonzero(groups == group)
            common[rows] -= common[min(rows, key=lambda row: cells[row].at)]
    branches: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
    for cell, middle, left in zip(cells, common, found.left, strict=True):
        own = branches.setdefault((cell.group, id(cell.branch)), [])
        own.append((cell.at, middle + left, course.share(float(left))))
    unlike = {group: float(np.mean(found.left[groups == group] ** 2)) for group in np.unique(groups).tolist()}
    worst = sorted(branches.items(), key=lambda one: (unlike[one[0][0]], len(one[1])), reverse=True)[:MOST]
    return tuple(Curve(*np.array(sorted(points)).T) for _, points in worst)


def measured(x: Array, y: Array) -> Curve:
    """Samples as they are, at most DRAWN of them."""
    every = slice(None, None, 1 + x.size // DRAWN)
    return Curve(x[every], y[every])


def write_curves(folder: Path, findings: Sequence[Pictured]) -> None:
    """Write structure.csv, a row a point: test, curve, x, y, apart."""
    tables = [
        pd.DataFrame(
            {"test": finding.name, "curve": curve.name or str(number), "x": curve.x, "y": curve.y}
            | {"apart": curve.apart if curve.apart.size else np.nan}
        )
        for finding in findings
        for number, curve in enumerate(finding.curves, 1)
    ]
    write_table(folder / FILE, pd.concat(tables) if tables else pd.DataFrame(columns=HEADER), digits=6)


def read_curves(folder: Path) -> dict[str, list[Curve]]:
    """By the tests' names; empty where the folder holds none."""
    if not (folder / FILE).is_file():
        return {}
    found: dict[str, list[Curve]] = {}
    parts: Any = read_table(folder / FILE).groupby(["test", "curve"], sort=False)
    for (test, name), rows in parts:
        x, y, apart = (rows[key].to_numpy(float) for key in HEADER[2:])
        found.setdefault(test, []).append(Curve(x, y, apart[np.isfinite(apart)], str(name)))
    return found

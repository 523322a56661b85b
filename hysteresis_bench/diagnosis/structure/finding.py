"""What a structure test answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.cells import Unlike
from hysteresis_bench.diagnosis.structure.course import Course

Name: TypeAlias = Literal[
    "sense",
    "reversal lag",
    "closure",
    "odd symmetry",
    "Masing's rule",
    "rising and falling branches",
    "return-point memory",
    "congruency",
    "rate independence",
    "growth of the area",
]

LEVEL = 0.001
"""Of p, from which data are said to refute."""


@dataclass(frozen=True, eq=False)
class Finding:
    """The answer of one test.

    statistic : in % of the output's range, or what `unit` says; NaN where the data do not allow the test
    p : of the noise alone;  words : a sentence with the consequence, or why there is no test
    least : RMSE that a law which has the property leaves at least on these records, unit of the output
    mixed : records answer differently
    curves : what a small picture shows, (x, y) each;  along : what x is
    """

    name: Name
    words: str
    statistic: float = np.nan
    p: float = np.nan
    least: float = 0.0
    unit: str = "%"
    mixed: bool = False
    curves: tuple[tuple[Array, Array], ...] = ()
    along: str = ""

    @property
    def applies(self) -> bool:
        """Do the data allow the test?"""
        return bool(np.isfinite(self.statistic))

    @property
    def refutes(self) -> bool:
        """The law that has the property."""
        return self.applies and self.p < LEVEL

    def as_dict(self) -> dict[str, Any]:
        """For a JSON file."""
        told = {"test": self.name, "applies": self.applies, "statistic": self.statistic, "unit": self.unit}
        return {**told, "p_value": self.p, "least_rmse": self.least, "words": self.words}


def told(
    name: Name, course: Course, found: Unlike | None, *, differ: str, why: str, without: str, along: str
) -> Finding:
    """The finding of a test of equal curves. differ : what differs;  why : the consequence;  without : why no test"""
    if found is None:
        return Finding(name, without)
    share, noise = course.share(found.rms), course.share(course.noise.rms)
    said = f"{differ} {share:.2g} % of the range (RMS), the noise is {noise:.2g} %"
    sentence = f"{said}: {why}." if found.p < LEVEL else f"{said}: as it should be (p = {found.p:.2g})."
    return Finding(name, sentence, share, found.p, found.least, curves=pictured(course, found), along=along)


def pictured(course: Course, found: Unlike, most: int = 12) -> tuple[tuple[Array, Array], ...]:
    """The longest of the curves that were compared, their constants taken off."""
    common: dict[Any, list[float]] = {}
    values = [cell.sign * float(cell.weights @ cell.branch.y) for cell in found.cells]
    for cell, value, left in zip(found.cells, values, found.left, strict=True):
        common.setdefault(cell.place, []).append(value - left)
    middle = {place: float(np.mean(parts)) for place, parts in common.items()}
    curves: dict[int, list[tuple[float, float]]] = {}
    for cell, left in zip(found.cells, found.left, strict=True):
        curves.setdefault(id(cell.branch), []).append((cell.at, middle[cell.place] + left))
    longest = sorted(curves.values(), key=len, reverse=True)[:most]
    return tuple(_sorted(points) for points in longest if len(points) > 1)


def _sorted(points: Sequence[tuple[float, float]]) -> tuple[Array, Array]:
    x, y = np.array(sorted(points)).T
    return x, y

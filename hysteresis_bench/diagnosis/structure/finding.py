"""What a structure test answers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from hysteresis_bench.diagnosis.structure.cells import Unlike
from hysteresis_bench.diagnosis.structure.course import Course
from hysteresis_bench.diagnosis.structure.curves import Curve, compared

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
    noise : in % of the output's range, NaN where the statistic is not
    curves : what a small picture shows;  along : what their x is
    """

    name: Name
    words: str
    statistic: float = np.nan
    p: float = np.nan
    least: float = 0.0
    unit: str = "%"
    mixed: bool = False
    noise: float = np.nan
    curves: tuple[Curve, ...] = ()
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
        told |= {"p_value": self.p, "refutes": self.refutes, "least_rmse": self.least, "words": self.words}
        return {**told, "noise": self.noise, "along": self.along}


def told(
    name: Name, course: Course, found: Unlike | None, *, differ: str, why: str, without: str, along: str
) -> Finding:
    """The finding of a test of equal curves. differ : what differs;  why : the consequence;  without : why no test"""
    if found is None:
        return Finding(name, without)
    share, noise = course.share(found.rms), course.share(course.noise.rms)
    said = f"{differ} {share:.2g} % of the range (RMS), the noise is {noise:.2g} %"
    sentence = f"{said}: {why}." if found.p < LEVEL else f"{said}: as it should be (p = {found.p:.2g})."
    return Finding(
        name, sentence, share, found.p, found.least, noise=noise, curves=compared(course, found), along=along
    )

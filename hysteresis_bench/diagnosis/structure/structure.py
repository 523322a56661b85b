"""Every structure test on the same records."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np

from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.diagnosis.structure.course import Course, course
from hysteresis_bench.diagnosis.structure.finding import Finding, Name
from hysteresis_bench.diagnosis.structure.properties.area_growth import area_growth
from hysteresis_bench.diagnosis.structure.properties.closure import closure
from hysteresis_bench.diagnosis.structure.properties.congruency import congruency
from hysteresis_bench.diagnosis.structure.properties.masing import masing
from hysteresis_bench.diagnosis.structure.properties.odd_symmetry import odd_symmetry
from hysteresis_bench.diagnosis.structure.properties.rate_independence import rate_independence
from hysteresis_bench.diagnosis.structure.properties.return_point import return_point
from hysteresis_bench.diagnosis.structure.properties.reversal_lag import reversal_lag
from hysteresis_bench.diagnosis.structure.properties.rising_falling import rising_falling
from hysteresis_bench.diagnosis.structure.properties.sense import sense

TESTS: tuple[Callable[[Course], Finding], ...] = (
    sense,
    reversal_lag,
    closure,
    odd_symmetry,
    rising_falling,
    masing,
    return_point,
    congruency,
    rate_independence,
    area_growth,
)


@dataclass(frozen=True, eq=False)
class Structure:
    """findings : one a test, in the order in which they are told;  span : of the output, its unit"""

    findings: tuple[Finding, ...]
    span: float = 0.0

    def of(self, name: Name) -> Finding:
        return next(finding for finding in self.findings if finding.name == name)

    @property
    def side(self) -> int:
        """1 where all loops run anticlockwise, output over input, -1 clockwise; 0 where they do not say."""
        found = self.of("sense")
        return int(np.sign(found.statistic)) if found.refutes and not found.mixed else 0


def structure(views: Sequence[View]) -> Structure:
    """Of these records together."""
    if not any(np.ptp(view.u) * np.ptp(view.y) for view in views):
        still = "The input or the output never moves: nothing can be asked."
        return Structure(tuple(Finding(name, still) for name in get_args(Name)))
    seen = course(views)
    return Structure(tuple(test(seen) for test in TESTS), seen.span_y)

"""The records as branches: what every structure test looks at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.noise import unresolved
from hysteresis_bench.diagnosis.evidence.noise_floor import FINEST
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.diagnosis.structure.colour import Colour, colour

SLOWEST = 5.0
"""Times the noise from sample to sample that slower noise may have: an autoregression of 0.9 has 4.4 times. What is
above is the law's, seen by too few samples."""
FIELDS = (6, 20)
"""Least and most fields into which the input's range is cut."""
DENSE = 6
"""Samples of a typical branch in a field."""
MANY = 400
"""Branches that are looked at, the first of every record: pairs of more take long to find."""
DEPTH = 4
"""Earlier reversals that are told of a branch."""


@dataclass(frozen=True, eq=False)
class Branch:
    """The way from one reversal of the input to the next, its scored part.

    record : its number;  order : of the branch in its record, 0 before the first reversal
    samples : among those of all records;  time, u, y : (samples,)
    way : 1 rising, -1 falling;  past : the input at the reversals before it, the last first, and at the first sample
    """

    record: int
    order: int
    samples: Array
    time: Array
    u: Array
    y: Array
    way: int
    past: tuple[float, ...]

    @property
    def start(self) -> float:
        return self.past[0]

    @property
    def depth(self) -> float:
        """How far the input may go before memory of the reversal before the last is wiped out; 0 where there was
        none."""
        return abs(self.past[0] - self.past[1]) if self.order else 0.0

    @property
    def way_back(self) -> Array:
        """Distance of the input from the reversal, (samples,)."""
        distance: Array = self.way * (self.u - self.start)
        return distance

    @property
    def speed(self) -> float:
        """Of the input, unit of the input a unit of time."""
        return float(abs(self.u[-1] - self.u[0]) / (self.time[-1] - self.time[0]))


@dataclass(frozen=True, eq=False)
class Course:
    """views : of the records;  branches : of all, in time;  y : outputs of all, (samples,)
    span_u, span_y : largest range in one record
    """

    views: tuple[View, ...]
    branches: tuple[Branch, ...]
    y: Array
    span_u: float
    span_y: float

    @cached_property
    def noise(self) -> Colour:
        """Of the output, and what the input's noise makes of it."""
        borders = np.cumsum([0, *(view.y.size for view in self.views)]).tolist()
        noises = [view.noise for view in self.views]
        rounding = max(noise.quantum for noise in noises) / np.sqrt(12.0)
        fast = max(noise.rms for noise in noises)
        found = colour([branch.y for branch in self.branches], borders, rounding, SLOWEST * fast)
        through = float(np.mean([noise.through_input**2 for noise in noises]))
        return Colour((*found.decays, 0.0), (*found.variances, through), found.freedom, found.borders)

    @cached_property
    def tolerance(self) -> float:
        """RMS by which equal curves may differ beside the noise: numerics, and what the samples miss of the input.
        Unit of the output."""
        return float(np.hypot(FINEST * self.span_y, unresolved([view.record for view in self.views])))

    @cached_property
    def repeats(self) -> float:
        """RMS by which cycles repeat worse than the noise, unit of the output; 0 where none does."""
        worst = max(view.noise.repeat_rms or 0.0 for view in self.views)
        return float(np.sqrt(max(worst**2 - self.noise.rms**2, 0.0)))

    @cached_property
    def field(self) -> float:
        """Width of the stretches of input over which curves are averaged, unit of the input."""
        dense = [branch.u.size * self.span_u / max(np.ptp(branch.u), 1e-12 * self.span_u) for branch in self.branches]
        least, most = FIELDS
        return self.span_u / float(np.clip(np.median(dense) // DENSE if dense else least, least, most))

    def share(self, value: float) -> float:
        """In % of the output's range."""
        return 100.0 * value / self.span_y


def course(views: Sequence[View]) -> Course:
    """Of records of which one at least moves, input and output."""
    span_u, span_y = max(float(np.ptp(view.u)) for view in views), max(float(np.ptp(view.y)) for view in views)
    branches: list[Branch] = []
    first = 0
    for number, view in enumerate(views):
        branches += _branches(number, first, view)[: max(MANY // len(views), 8)]
        first += view.y.size
    return Course(tuple(views), tuple(branches), np.concatenate([view.y for view in views]), span_u, span_y)


def _branches(number: int, first: int, view: View) -> list[Branch]:
    u, history = view.record.input, view.record.history
    ends = [0, *view.turns.tolist(), u.size - 1]
    found = []
    for order, (begin, end) in enumerate(pairwise(ends)):
        samples = np.arange(max(begin, history), end + 1)
        if samples.size < 3:
            continue
        past = tuple(float(u[turn]) for turn in ends[order::-1][: DEPTH + 1])
        scored = samples - history
        way = 1 if u[end] > u[begin] else -1
        found.append(
            Branch(number, order, first + scored, view.time[scored], view.u[scored], view.y[scored], way, past)
        )
    return found

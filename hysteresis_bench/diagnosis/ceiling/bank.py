"""Columns of a black box that simulates: what the input's past, the time and the path offer, never the output's.

Four families, each with all of the one before: a curve of the input; its memory, as curves of plays [1] and as lags
along the path, of which Duhem's operators consist [2]; lags in time of all that; time, path and further measured
columns times that. All may be of an input that arrives late. In a memory of past extrema, plays with curves are dense.

[1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
[2] B. D. Coleman, M. L. Hodgdon, Int. J. Eng. Sci. 24 (1986) 897: dy = alpha |du| (f(u) - y) + g(u) du.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.signals import Record

RADII = np.array([0.03, 0.07, 0.13, 0.2, 0.3, 0.43, 0.6, 0.8])
"""Half-widths of the plays, as shares of half the input's range."""
FEW = [2, 4, 6]
"""Of them, whose lags and products with time and path are offered."""
INTERVALS, OF_PLAYS = 10, 5
"""Of the splines of the input, and of a play."""
PATHS = np.array([0.1, 0.3, 1.0, 3.0])
"""Constants of the lags along the path, as shares of half the input's range."""
LAGS = 6
"""Time constants on a logarithmic grid, from two samples to half of the longest record."""
ARRIVALS = 6
"""Time constants by which the input may arrive late, from a sample to a sixth of the shortest cycle."""

CURVE, MEMORY, LAGGED, TIMED = range(4)


@dataclass(frozen=True)
class Family:
    """level : the largest family of columns that is in it;  arrival : time constant by which its input arrives late"""

    level: int
    arrival: float = 0.0


@dataclass(frozen=True, eq=False)
class Bank:
    """The columns of every n-th scored sample of these records;  stride : n"""

    records: tuple[Record, ...]
    stride: int = 1

    @cached_property
    def arrivals(self) -> list[float]:
        """Time constants of an input that arrives late, 0 first; nothing but 0 without a time base."""
        shortest = min(_cycle(record) for record in self.records) / 6.0
        if not self._timed or shortest <= self._step:
            return [0.0]
        return [0.0, *np.geomspace(self._step, shortest, ARRIVALS).tolist()]

    def columns(self, family: Family) -> Array:
        """(samples of all records, any)"""
        found = [np.column_stack(self._of(record, family))[record.scored] for record in self.records]
        return np.vstack(found)[:: self.stride].copy()

    def _of(self, record: Record, family: Family) -> list[Array]:
        from hysteresis_bench.kernels.lag import lag
        from hysteresis_bench.kernels.play import play

        time, x = record.time - record.time[0], (record.input - self._range[0]) / self._range[1]
        if family.arrival:
            x = covariates.low_pass(time, x, family.arrival)
        found = [_spline(x, INTERVALS)]
        if family.level == CURVE:
            return found
        plays = play(np.ascontiguousarray(x[:, None]), RADII)
        path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(x)))])
        found += [*(_spline(one, OF_PLAYS) for one in plays.T), x[:, None] * plays, x[:, None] ** 2 * plays]
        found += [lag(path, np.ascontiguousarray(x[:, None] ** power), PATHS) for power in (1, 2, 3)]
        few = np.column_stack([x, plays[:, FEW]])
        if family.level >= LAGGED and self._timed:
            late = np.column_stack([few, x**2, x**3, plays[:, FEW] ** 2])
            constants = np.geomspace(2.0 * self._step, max(0.5 * self._longest, 4.0 * self._step), LAGS)
            found += [covariates.low_pass(time, late, constant) - late for constant in constants]
        if family.level >= TIMED:
            courses = [path / self._way, *([time / self._longest] if self._timed else [])]
            courses = [power for course in courses for power in (course, course**2)]
            courses += [(record.columns[name] - mean) / scatter for name, (mean, scatter) in self._measured.items()]
            of = np.column_stack([np.ones_like(x), few, x**2])
            found += [course[:, None] * of for course in courses]
        return found

    @cached_property
    def _timed(self) -> bool:
        return all(record.timed for record in self.records)

    @cached_property
    def _range(self) -> tuple[float, float]:
        """Centre and half-width of all inputs."""
        low, high = (float(of([of(record.input) for record in self.records])) for of in (np.min, np.max))
        return 0.5 * (low + high), 0.5 * (high - low) or 1.0

    @cached_property
    def _step(self) -> float:
        return float(np.median(np.concatenate([np.diff(record.time) for record in self.records])))

    @cached_property
    def _longest(self) -> float:
        return max(float(record.time[-1] - record.time[0]) for record in self.records)

    @cached_property
    def _way(self) -> float:
        """The longest path of an input, in halves of the range."""
        return max(float(np.sum(np.abs(np.diff(record.input)))) for record in self.records) / self._range[1] or 1.0

    @cached_property
    def _measured(self) -> dict[str, tuple[float, float]]:
        """Mean and scatter of every further column that all records have and that varies."""
        shared = sorted(set.intersection(*({*record.columns} for record in self.records)))
        values = {name: np.concatenate([record.columns[name] for record in self.records]) for name in shared}
        return {name: (float(np.mean(of)), float(np.std(of))) for name, of in values.items() if np.std(of) > 0.0}


def _spline(x: Array, intervals: int) -> Array:
    """Cubic B-splines of what lies between -1 and 1, held beyond."""
    from hysteresis_bench.kernels.cubic_spline import cubic_spline

    knots = np.concatenate([[-1.0] * 3, np.linspace(-1.0, 1.0, intervals + 1), [1.0] * 3])
    columns: Array = cubic_spline(np.clip(x, -1.0, 1.0), knots)
    return columns


def _cycle(record: Record) -> float:
    """Typical duration of a cycle."""
    turns = covariates.turning_points(record.input, covariates.resolution_of(record.input))
    if turns.size > 1:
        return 2.0 * float(np.median(np.diff(record.time[turns])))
    return float(record.time[-1] - record.time[0])

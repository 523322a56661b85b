"""The meter: a loss on the unit box that counts evaluations, refuses the one past the budget, and records."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import TypeAlias

import numpy as np

from hysteresis_bench import contracts
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.fit.loss import Loss
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

CEILING = 1e9
"""Errors are cut at this many times the largest measured |output|: what a simulation that has left every
reasonable range, or is NaN, is worth. Finite, because NaN makes pymoo's CMA-ES hang and inf ends nlopt's
DIRECT-L after 9 calls."""

BLOCK_BYTES = 24 << 20
"""Simulated output of a block of a swarm at most, but for the longest records: it stays in a cache of 32 MB."""
LEAST_BLOCK, MOST_BLOCK = 16, 64
"""Columns below which a kernel no longer fills its vector lanes, and those that it integrates side by side."""


OnEvaluated: TypeAlias = Callable[[int], None]
"""Called with the count of evaluations so far."""


class BudgetSpent(BaseException):
    """The search is over. Not an Exception, so that no library's handler mistakes it for a failed call."""


class OutsideBox(ValueError):
    """An optimizer proposed a point outside the unit box."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is to be identified: a system, the records it must reproduce, a search space, a loss."""

    system: System
    records: tuple[Record, ...]
    space: Space
    loss: Loss

    @cached_property
    def samples(self) -> int:
        """Number of scored samples over all records."""
        return sum(record.measured.size for record in self.records)

    @cached_property
    def scale(self) -> float:
        """Largest |output| measured, the y_max of the papers."""
        return max(float(np.max(np.abs(record.measured))) for record in self.records) or 1.0

    @cached_property
    def worst(self) -> float:
        """The finite sum of squares that answers NaN and infinity."""
        return self.samples * (CEILING * self.scale) ** 2

    @cached_property
    def ceiling(self) -> float:
        """The loss of that."""
        return float(self.loss.of(np.array(self.worst), self.samples, self.scale))

    @cached_property
    def linear(self) -> tuple[int, ...]:
        """Coordinates of the unit box in which the residuals are jointly affine."""
        names = self.system.linear
        parameters = enumerate(self.space.parameters)
        return tuple(row for row, q in parameters if q.name in names and q.scaling == "linear")

    @cached_property
    def block(self) -> int:
        """Columns simulated at once."""
        longest = max(record.time.size for record in self.records)
        return min(MOST_BLOCK, max(LEAST_BLOCK, BLOCK_BYTES // (8 * longest)))

    @cached_property
    def _measured(self) -> tuple[tuple[slice, Array], ...]:
        """What of every record is scored, cut once: that takes as long as a short simulation."""
        return tuple((record.scored, record.measured) for record in self.records)

    def squares(self, points: Array) -> Array:
        """Sum of squared errors over all scored samples; points : (dimension, swarm) in the unit box."""
        from hysteresis_bench.kernels.squares import sum_of_squares

        values = np.ascontiguousarray(self.space.from_unit(points))
        total = np.empty(values.shape[1])
        for first in range(0, values.shape[1], self.block):
            columns = slice(first, first + self.block)
            part = np.ascontiguousarray(values[:, columns])
            responses = self.system.responses(self.records, part)
            squares = (
                sum_of_squares(simulated[scored], measured)
                for simulated, (scored, measured) in zip(responses, self._measured, strict=True)
            )
            total[columns] = reduce(np.add, squares)
        return total

    def losses(self, points: Array) -> Array:
        """Losses of a swarm, every one finite: (dimension, swarm) -> (swarm,)."""
        with np.errstate(over="ignore", invalid="ignore"):
            losses = self.loss.of(self.squares(points), self.samples, self.scale)
        return np.fmin(losses, self.ceiling)

    def residuals(self, points: Array) -> Array:
        """Simulated minus measured, (scored samples, swarm), finite; points : (dimension, swarm) in the unit box."""
        return self.errors(np.ascontiguousarray(self.space.from_unit(points)), self.block)

    def errors(self, values: Array, block: int) -> Array:
        """The same for values (dimension, swarm), in units, so many columns at once."""
        from hysteresis_bench.kernels.squares import residuals_into

        limit = CEILING * self.scale
        joined = np.empty((self.samples, values.shape[1]))
        for first in range(0, values.shape[1], block):
            columns = slice(first, first + block)
            part, row = np.ascontiguousarray(values[:, columns]), 0
            responses = self.system.responses(self.records, part)
            for simulated, (scored, measured) in zip(responses, self._measured, strict=True):
                rows = slice(row, row := row + measured.size)
                residuals_into(joined[rows, columns], simulated[scored], measured, limit)
        return joined


@dataclass(frozen=True, eq=False)
class Trace:
    """Best so far: one entry an improvement, which determines the best at every count of evaluations.

    evaluations : (improvements,) count at which each was found, from 1
    losses : (improvements,) strictly falling
    points : (improvements, dimension) in units
    """

    evaluations: Array
    losses: Array
    points: Array


class Objective:
    """A problem on a meter; contracts.Objective says what an optimizer may rely on, `shown` what it gets."""

    def __init__(self, problem: Problem, budget: int, on_evaluated: OnEvaluated | None = None) -> None:
        self._problem = problem
        self._on_evaluated = on_evaluated
        self.budget = budget
        self.dimension = problem.space.dimension
        self.linear = problem.linear
        self.evaluations = 0
        self.best = np.inf
        self._improvements: list[tuple[int, float, Array]] = []

    @property
    def best_point(self) -> Array | None:
        """(dimension,) in the unit box, or None before the first evaluation."""
        return self._improvements[-1][2] if self._improvements else None

    @property
    def trace(self) -> Trace:
        evaluations = np.array([entry[0] for entry in self._improvements], dtype=np.int64)
        losses = np.array([entry[1] for entry in self._improvements], dtype=float)
        points = np.array([entry[2] for entry in self._improvements]).reshape(-1, self.dimension)
        return Trace(evaluations, losses, self._problem.space.from_unit(points.T).T)

    def __call__(self, point: Array) -> float:
        return float(self.many(np.asarray(point, dtype=float).reshape(self.dimension, 1))[0])

    def many(self, points: Array) -> Array:
        points = np.asarray(points, dtype=float)
        self._check(points)
        affordable = points[:, : self._left()]
        losses = self._problem.losses(affordable)
        self._record(losses, affordable)
        if affordable.shape[1] < points.shape[1]:
            raise BudgetSpent
        return losses

    def residuals(self, point: Array) -> Array:
        column: Array = self.residual_swarm(np.asarray(point, dtype=float).reshape(self.dimension, 1))[:, 0]
        return column

    def residual_swarm(self, points: Array) -> Array:
        points = np.asarray(points, dtype=float)
        self._check(points)
        affordable = points[:, : self._left()]
        residuals = self._problem.residuals(affordable)
        squares = np.einsum("ij,ij->j", residuals, residuals)
        losses = self._problem.loss.of(squares, self._problem.samples, self._problem.scale)
        self._record(np.fmin(losses, self._problem.ceiling), affordable)
        if affordable.shape[1] < points.shape[1]:
            raise BudgetSpent
        return residuals

    def _left(self) -> int:
        left = self.budget - self.evaluations
        if left <= 0:
            raise BudgetSpent
        return left

    def _check(self, points: Array) -> None:
        if points.ndim != 2 or points.shape[0] != self.dimension:
            raise ValueError(f"points are (dimension, swarm) = ({self.dimension}, n), not {points.shape}")
        if not (points.size == 0 or (points.min() >= 0.0 and points.max() <= 1.0)):
            row, column = np.argwhere(~((points >= 0.0) & (points <= 1.0)))[0]
            raise OutsideBox(f"{self._problem.space.names[row]} = {points[row, column]:.6g} lies outside the unit box")

    def _record(self, losses: Array, points: Array) -> None:
        while (better := np.flatnonzero(losses < self.best)).size:
            index = int(better[0])
            self.best = float(losses[index])
            self._improvements.append((self.evaluations + index + 1, self.best, points[:, index].copy()))
        self.evaluations += losses.size
        if self._on_evaluated:
            self._on_evaluated(self.evaluations)

    def shown(self) -> contracts.Objective:
        """What an optimizer gets: it can ask and read, and no attribute of it leads to the meter or the problem."""
        meter = self

        class Metered:
            """contracts.Objective. A class of its own for every search: what is done to it changes no other."""

            __slots__ = ()

            @property
            def dimension(self) -> int:
                return meter.dimension

            @property
            def budget(self) -> int:
                return meter.budget

            @property
            def evaluations(self) -> int:
                return meter.evaluations

            @property
            def linear(self) -> tuple[int, ...]:
                return meter.linear

            def __call__(self, point: Array) -> float:
                return meter(point)

            def many(self, points: Array) -> Array:
                return meter.many(points)

            def residuals(self, point: Array) -> Array:
                return meter.residuals(point)

            def residual_swarm(self, points: Array) -> Array:
                return meter.residual_swarm(points)

        return Metered()

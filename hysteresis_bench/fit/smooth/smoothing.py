"""Laws of many linear parameters: the least squares of a smooth one, how smooth being what predicts best.

|A x - b|² + weight |R x|² is the least [1] for x inside its bounds, R the law's roughness; the weight, and the few
parameters that are not linear, are those whose law predicts best what was left out of the fit.

[1] P. H. C. Eilers, B. D. Marx, Statistical Science 11 (1996) 89.
[2] R. J. Tibshirani, R. Tibshirani, Ann. Appl. Stat. 3 (2009) 822.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any, Protocol, runtime_checkable

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.smooth.pivoting import least_above
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.whole import LeftOut

SOLVED = "Solved, not searched: the least squares of a law as smooth as predicts best what was left out of the fit."
SCREENED, STEPS = 4, 15
"""Points of the parameters that are not linear, and steps downhill from the best of them, for each dimension."""
LIGHTEST, HEAVIEST = -6.0, 3.0
"""Powers of ten between which the weight lies, as a share of what makes both terms alike."""
WEIGHTS = 25
"""Of them, tried from the heaviest one down."""
RIDGE = 1e-10
"""Share of the diagonal that keeps every system definite."""


@runtime_checkable
class Rough(Protocol):
    """A model whose linear parameters are so many that they want to be smooth."""

    @property
    def linear(self) -> tuple[str, ...]: ...

    def roughness(self, p: Any) -> Array:
        """(rows, len(linear)): what a smooth law has little of; p as in `Model.simulate`, a swarm of 1, of which only
        the parameters that are not linear matter."""


def solvable(system: System) -> bool:
    """Is it a rough law whose linear parameters are still linear behind the effects around it?"""
    return isinstance(system.model, Rough) and {*system.model.linear} <= {*system.linear}


@dataclass(frozen=True, eq=False)
class Smoothed:
    """values : (dimension,) in units;  left_out : (scored samples,) errors by what did not count them
    weight : of the roughness, as a power of ten;  freedom : effective number of parameters
    """

    values: Array
    left_out: Array
    weight: float
    freedom: float


@dataclass(frozen=True, eq=False)
class Smoothing:
    """problem : of a model with a roughness, and of effects around it."""

    problem: Problem

    def searched(self, out: LeftOut) -> Smoothed:
        """The smoothest law that predicts as well as the best one, as far as what is left out can say so."""
        from scipy.optimize import minimize
        from scipy.stats.qmc import Halton

        dimension = len(self._others) + 1

        tried = []

        def left(point: Array) -> float:
            tried.append(self._predicted(np.clip(point, 0.0, 1.0), out.blocks))
            return _rms(tried[-1])

        points = Halton(dimension, scramble=False).random(SCREENED * dimension + 1)[1:]
        first = points[int(np.argmin([left(point) for point in points]))]
        options = {"maxfev": STEPS * dimension, "xatol": 1e-3, "fatol": 1e-4 * left(first)}
        found = minimize(left, first, method="Nelder-Mead", bounds=[(0.0, 1.0)] * dimension, options=options)
        point = np.clip(found.x, 0.0, 1.0)
        errors = best = self._predicted(point, out.blocks)
        for share in np.linspace(1.0, point[-1], WEIGHTS, endpoint=False):
            smoother = np.append(point[:-1], share)
            errors = self._predicted(smoother, out.blocks)
            if out.as_good(best, errors):
                point = smoother
                break
        else:
            errors = best
        values, freedom = self._solved(point)
        return Smoothed(values, _unchosen(errors, tried, out.blocks), self._power(point), freedom)

    def refitted(self, known: Smoothed) -> Array:
        """Values (dimension,) in units, of the same smoothness, for this problem's records."""
        return self._solved(self._point(known))[0]

    def without(self, known: Smoothed, out: Array) -> Array:
        """Errors (left out,) of samples by the law of the same smoothness that counts the others;  out : (samples,)"""
        if not out.any():
            return np.empty(0)
        return self._predicted(self._point(known), Blocks(~out, (~out).astype(int), 1))[out]

    def _point(self, known: Smoothed) -> Array:
        point = self.problem.space.to_unit(known.values[:, None])[self._others, 0]
        return np.append(point, (known.weight - LIGHTEST) / (HEAVIEST - LIGHTEST))

    def _power(self, point: Array) -> float:
        return float(LIGHTEST + point[-1] * (HEAVIEST - LIGHTEST))

    def _predicted(self, point: Array, blocks: Blocks) -> Array:
        columns, target = self._columns(point)
        normal, descent, penalty = columns.T @ columns, columns.T @ target, self._penalty(point, columns)
        errors, least = np.empty(target.size), np.empty(0)
        for fold in range(blocks.folds):
            out = blocks.fold == fold
            part, aim = columns[out], target[out]
            least = self._least(normal - part.T @ part, descent - part.T @ aim, penalty, least)
            errors[out] = aim - part @ least
        return errors

    def _solved(self, point: Array) -> tuple[Array, float]:
        """Values (dimension,) in units, and the effective number of parameters."""
        columns, target = self._columns(point)
        normal, penalty = columns.T @ columns, self._penalty(point, columns)
        found = self._least(normal, columns.T @ target, penalty)
        free = np.flatnonzero((found > self._low) & (found < self._high))
        one, all_ = (matrix[np.ix_(free, free)] for matrix in (normal, normal + penalty))
        ridge = RIDGE * np.diag(np.diag(all_) + np.finfo(float).tiny)
        freedom = float(np.trace(np.linalg.solve(all_ + ridge, one))) + len(self._others)
        values = self._values(point)[:, 0]
        values[self._rows] = found
        return values, freedom

    def _columns(self, point: Array) -> tuple[Array, Array]:
        """What each linear parameter answers for, (scored samples, linear), and what they have to explain."""
        count = len(self._rows)
        values = np.repeat(self._values(point), count + 1, axis=1)
        values[self._rows] = 0.0
        values[self._rows, range(1, count + 1)] = self._units
        found = self.problem.residuals(self.problem.space.to_unit(values))
        return (found[:, 1:] - found[:, :1]) / self._units, -found[:, 0]

    def _penalty(self, point: Array, columns: Array) -> Array:
        """Weighted square of the roughness, (linear, linear)."""
        model: Any = self.problem.system.model
        names = self.problem.space.names
        rough: Array = model.roughness(SimpleNamespace(**dict(zip(names, self._values(point), strict=True))))
        square = np.zeros((len(self._rows), len(self._rows)))
        own = np.array([self._rows.index(names.index(name)) for name in model.linear])
        square[np.ix_(own, own)] = rough.T @ rough
        # of those that can be rough alone: the others have other units
        alike = np.sum(columns[:, np.diag(square) > 0.0] ** 2) / max(np.trace(square), np.finfo(float).tiny)
        return np.asarray(10.0 ** self._power(point) * alike * square)

    def _least(self, normal: Array, descent: Array, penalty: Array, near: Array | None = None) -> Array:
        """The least of x normal x / 2 - descent x + x penalty x / 2 with x on its side of 0, (linear,); near : one of
        like terms, empty where none is known."""
        matrix, right = (normal + penalty) * np.outer(self._signs, self._signs), descent * self._signs
        size = np.sqrt(np.diag(matrix) + np.finfo(float).tiny)
        matrix = matrix / np.outer(size, size) + RIDGE * np.eye(size.size)
        inside = near != 0.0 if near is not None and near.size else np.ones(size.size, dtype=bool)
        found = least_above(matrix, right / size, (self._low < 0.0) & (self._high > 0.0), inside)
        least: Array = np.clip(found / size * self._signs, self._low, self._high)
        return least

    def _values(self, point: Array) -> Array:
        """(dimension, 1) in units, the linear ones 0; point : the others in the unit box, and the weight."""
        unit = np.zeros((self.problem.space.dimension, 1))
        unit[self._others, 0] = point[:-1]
        values = self.problem.space.from_unit(unit)
        values[self._rows] = 0.0
        return values

    @cached_property
    def _rows(self) -> list[int]:
        return list(self.problem.linear)

    @cached_property
    def _others(self) -> list[int]:
        return [row for row in range(self.problem.space.dimension) if row not in self.problem.linear]

    @cached_property
    def _low(self) -> Array:
        return np.array([self.problem.space.parameters[row].lower for row in self._rows])

    @cached_property
    def _high(self) -> Array:
        return np.array([self.problem.space.parameters[row].upper for row in self._rows])

    @cached_property
    def _units(self) -> Array:
        """A step of each that stays inside its box."""
        return np.where(self._high > 0.0, self._high, self._low)

    @cached_property
    def _signs(self) -> Array:
        return np.where(self._high > 0.0, 1.0, -1.0)


def _unchosen(errors: Array, tried: Sequence[Array], blocks: Blocks) -> Array:
    """Errors (samples,) of every fold by what was tried and predicts the other folds best, where these are larger: what
    is the least of many errors is no measure of how it predicts [2]."""
    squares = np.array([np.bincount(blocks.fold, one**2, blocks.folds) for one in (errors, *tried)])
    others = np.argmin(squares.sum(axis=1, keepdims=True) - squares, axis=0)
    found = errors.copy()
    for fold, best in enumerate(others):
        if squares[best, fold] > squares[0, fold]:
            of = blocks.fold == fold
            found[of] = tried[best - 1][of]
    return found


def _rms(errors: Array) -> float:
    return float(np.sqrt(np.mean(errors**2)))

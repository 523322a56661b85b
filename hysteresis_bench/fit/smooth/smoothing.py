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
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.smooth.pivoting import least_above
from hysteresis_bench.fit.smooth.starts import starts
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.whole import LeftOut
from hysteresis_bench.kernels.root_mean_square import rms

SOLVED = "Solved, not searched: the least squares of a law as smooth as predicts best what was left out of the fit."
STEPS = 15
"""Downhill from the best of the first points, for each of the parameters that are not linear."""
LIGHTEST, HEAVIEST = -6.0, 3.0
"""Powers of ten between which the weight lies, as a share of what makes both terms alike."""
WEIGHTS = 25
"""Of them, tried from the heaviest one down."""
RIDGE = 1e-10
"""Share of the diagonal that keeps every system definite."""


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
class Part:
    """Some of the samples.

    places : (samples,), of all;  target : (samples,), what the law has to explain
    columns : (samples, linear), what each linear parameter answers for, turned so that it counts from 0 up
    """

    places: Array
    columns: Array
    target: Array

    @cached_property
    def normal(self) -> Array:
        product: Array = self.columns.T @ self.columns
        return product

    @cached_property
    def descent(self) -> Array:
        product: Array = self.columns.T @ self.target
        return product


@dataclass(frozen=True, eq=False)
class Equations:
    """Of one point of the parameters that are not linear: what the least squares of all weights share.

    folds : what each leaves out;  normal, descent : (linear, linear), (linear,), of all samples
    penalty : (linear, linear), the square of the roughness, as large as `normal`
    """

    folds: tuple[Part, ...]
    normal: Array
    descent: Array
    penalty: Array


@dataclass(frozen=True, eq=False)
class Smoothing:
    """problem : of a model with a roughness, and of effects around it."""

    problem: Problem

    def searched(self, out: LeftOut) -> Smoothed:
        """The smoothest law that predicts as well as the best one, as far as what is left out can say so."""
        from scipy.optimize import minimize

        dimension = len(self._others) + 1
        near = np.ones((out.blocks.folds, len(self._rows)))
        tried = []

        def left(point: Array) -> float:
            point = np.clip(point, 0.0, 1.0)
            tried.append(self._predicted(self._equations(point, out.blocks), point, near))
            return rms(tried[-1])

        points = starts([self.problem.space.parameters[row] for row in self._others])
        losses = [left(point) for point in points]
        first, options = points[int(np.argmin(losses))], {"maxfev": STEPS * dimension, "xatol": 1e-3}
        options["fatol"] = 1e-4 * min(losses)
        found = minimize(left, first, method="Nelder-Mead", bounds=[(0.0, 1.0)] * dimension, options=options)
        point = np.clip(found.x, 0.0, 1.0)
        equations = self._equations(point, out.blocks)
        errors = best = self._predicted(equations, point, near)
        for share in np.linspace(1.0, point[-1], WEIGHTS, endpoint=False):
            smoother = np.append(point[:-1], share)
            errors = self._predicted(equations, smoother, near)
            if out.as_good(best, errors):
                point = smoother
                break
        else:
            errors = best
        values, freedom = self._solved(equations, point)
        return Smoothed(values, _unchosen(errors, tried, out.blocks), self._power(point), freedom)

    def refitted(self, known: Smoothed) -> Array:
        """Values (dimension,) in units, of the same smoothness, for this problem's records."""
        point = self._point(known)
        return self._solved(self._equations(point), point)[0]

    def without(self, known: Smoothed, blocks: Blocks) -> Array:
        """Errors (samples, folds) of all samples by the laws of the same smoothness that do not count each fold."""
        point, errors = self._point(known), np.empty((self.problem.samples, blocks.folds))
        columns, target = self._columns(point)
        penalty = 10.0 ** self._power(point) * self._penalty(point, columns.T @ columns)
        for fold, counts in enumerate(blocks.training.T > 0.0):
            part = Part(np.flatnonzero(counts), columns[counts], target[counts])
            found = self._least(part.normal + penalty, part.descent, np.ones(len(self._rows)))
            errors[:, fold] = target - columns @ found
        return errors

    def _point(self, known: Smoothed) -> Array:
        point = self.problem.space.to_unit(known.values[:, None])[self._others, 0]
        return np.append(point, (known.weight - LIGHTEST) / (HEAVIEST - LIGHTEST))

    def _power(self, point: Array) -> float:
        return float(LIGHTEST + point[-1] * (HEAVIEST - LIGHTEST))

    def _equations(self, point: Array, blocks: Blocks | None = None) -> Equations:
        """Whatever the point's weight; without blocks nothing is left out."""
        columns, target = self._columns(point)
        fold, folds = (blocks.fold, blocks.folds) if blocks else (np.zeros(target.size), 0)
        places = [np.flatnonzero(fold == one) for one in range(folds)]
        parts = [Part(some, columns[some], target[some]) for some in (*places, np.flatnonzero(fold >= folds))]
        normal = np.sum([part.normal for part in parts], axis=0)
        descent = np.sum([part.descent for part in parts], axis=0)
        return Equations(tuple(parts[:-1]), normal, descent, self._penalty(point, normal))

    def _predicted(self, equations: Equations, point: Array, near: Array) -> Array:
        """Errors (samples,) of every fold by what the others say, as smooth as the point's weight makes it.

        near : (folds, linear), what is not 0 likely is not; the solutions take its place
        """
        penalty = 10.0 ** self._power(point) * equations.penalty
        errors = np.empty(self.problem.samples)
        for fold, part in enumerate(equations.folds):
            matrix = equations.normal - part.normal + penalty
            near[fold] = self._least(matrix, equations.descent - part.descent, near[fold])
            errors[part.places] = part.target - part.columns @ near[fold]
        return errors

    def _solved(self, equations: Equations, point: Array) -> tuple[Array, float]:
        """Values (dimension,) in units, and the effective number of parameters."""
        normal = equations.normal
        matrix = normal + 10.0 ** self._power(point) * equations.penalty
        found = self._least(matrix, equations.descent, np.ones(len(self._rows)))
        low, high = self._span
        free = np.flatnonzero((found > low) & (found < high))
        one, all_ = (of[np.ix_(free, free)] for of in (normal, matrix))
        ridge = RIDGE * np.diag(np.diag(all_) + np.finfo(float).tiny)
        freedom = float(np.trace(np.linalg.solve(all_ + ridge, one))) + len(self._others)
        values = self._values(point)[:, 0]
        values[self._rows] = found * self._signs
        return values, freedom

    def _columns(self, point: Array) -> tuple[Array, Array]:
        """What each linear parameter answers for, (scored samples, linear), turned so that it counts from 0 up, and
        what they have to explain."""
        count = len(self._rows)
        values = np.repeat(self._values(point), count + 1, axis=1)
        values[self._rows] = 0.0
        values[self._rows, range(1, count + 1)] = self._units
        found = self.problem.errors(values, count + 1)
        columns = found[:, 1:] - found[:, :1]
        columns /= np.abs(self._units)
        return columns, -found[:, 0]

    def _penalty(self, point: Array, normal: Array) -> Array:
        """Square of the roughness, (linear, linear), as large as the columns' own."""
        model: Any = self.problem.system.model
        names = self.problem.space.names
        rough: Array = model.roughness(SimpleNamespace(**dict(zip(names, self._values(point), strict=True))))
        rough = rough * self._signs[self._own]
        square = np.zeros_like(normal)
        square[np.ix_(self._own, self._own)] = rough.T @ rough
        # of those that can be rough alone: the others have other units
        alike = np.diag(normal)[np.diag(square) > 0.0].sum() / max(np.trace(square), np.finfo(float).tiny)
        return np.asarray(alike * square)

    def _least(self, matrix: Array, descent: Array, near: Array) -> Array:
        """The least of x matrix x / 2 - descent x with x inside its bounds, (linear,); near : one of like terms"""
        size = np.sqrt(np.diag(matrix) + np.finfo(float).tiny)
        matrix = matrix / np.outer(size, size) + RIDGE * np.eye(size.size)
        found = least_above(matrix, descent / size, self._free, near != 0.0)
        return np.clip(found / size, *self._span)

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
    def _own(self) -> list[int]:
        """Of the linear ones, those of the model itself."""
        model: Any = self.problem.system.model
        place = {name: self._rows.index(row) for row, name in enumerate(self.problem.space.names) if row in self._rows}
        return [place[name] for name in model.linear]

    @cached_property
    def _low(self) -> Array:
        return np.array([self.problem.space.parameters[row].lower for row in self._rows])

    @cached_property
    def _high(self) -> Array:
        return np.array([self.problem.space.parameters[row].upper for row in self._rows])

    @cached_property
    def _free(self) -> Array:
        """Which may have either sign."""
        return (self._low < 0.0) & (self._high > 0.0)

    @cached_property
    def _span(self) -> tuple[Array, Array]:
        """Bounds of what is turned."""
        turned = self._signs < 0.0
        return np.where(turned, -self._high, self._low), np.where(turned, -self._low, self._high)

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

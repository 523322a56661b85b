"""Nested cross-validation of ridge regressions [1]: inner folds choose the columns and the penalty, outer ones judge.

[1] M. Stone, J. R. Statist. Soc. B 36 (1974) 111; S. Varma, R. Simon, BMC Bioinformatics 7 (2006) 91.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.ceiling.bank import CURVE, LAGGED, MEMORY, TIMED, Bank, Family
from hysteresis_bench.diagnosis.ceiling.folds import Fold, Folds

PENALTIES = 10.0 ** np.arange(-7.0, 1.5, 1.2)
"""Ridges, as shares of the mean square of a column."""
CONSTANT = 1e3
"""Value of the constant among columns of scatter 1: it is not shrunk."""


@dataclass(frozen=True, eq=False)
class Regression:
    """Ridge regressions on the same columns, each without some of the parts.

    columns : (samples, any), of which none is constant;  targets : (samples, targets);  part : (samples,)
    """

    columns: Array
    targets: Array
    part: Array
    known: dict[frozenset[int], Array] = field(default_factory=dict)

    def errors(self, fold: Fold, target: int) -> Array:
        """(judged samples, penalties) of a fit without what the fold leaves out."""
        found = self._without(fold.without)[:, :, target]
        errors: Array = self.targets[fold.judged, target][:, None] - self.columns[fold.judged] @ found.T
        return errors

    def _without(self, parts: frozenset[int]) -> Array:
        """Coefficients, (penalties, columns, targets)."""
        from scipy.linalg import cho_factor, cho_solve

        if parts not in self.known:
            kept = [part for part in range(self._squares.shape[0]) if part not in parts]
            square, product = self._squares[kept].sum(axis=0), self._products[kept].sum(axis=0)
            samples, one = float(np.isin(self.part, kept).sum()), np.eye(square.shape[0])
            self.known[parts] = np.stack(
                [cho_solve(cho_factor(square + share * samples * one), product) for share in PENALTIES]
            )
        return self.known[parts]

    @cached_property
    def _squares(self) -> Array:
        """(parts, columns, columns)"""
        return np.stack([part.T @ part for part in self._split(self.columns)])

    @cached_property
    def _products(self) -> Array:
        """(parts, columns, targets)"""
        both = zip(self._split(self.columns), self._split(self.targets), strict=True)
        return np.stack([part.T @ target for part, target in both])

    def _split(self, values: Array) -> list[Array]:
        return [values[self.part == number] for number in range(int(self.part.max()) + 1)]


@dataclass(frozen=True, eq=False)
class Chosen:
    """score : geometric mean of the inner folds' mean squares, so that one that is far from all others does not choose
    errors : (judged samples,) on the outer fold;  level : of the columns in `bank`
    """

    score: float
    errors: Array
    level: int


@dataclass(frozen=True, eq=False)
class Nested:
    """centred : every record has a constant of its own, which is estimated on all of its samples

    targets : (samples, 1 + folds), the output, then what the named model leaves of it without each outer fold
    number : (samples,) of the record
    """

    bank: Bank
    folds: Folds
    targets: Array
    number: Array
    centred: bool
    known: dict[Family, Regression] = field(default_factory=dict)

    def chosen(self, fold: Fold, *, beside: bool) -> Chosen:
        """What predicts best on the inner folds, alone or beside the named model. By how much the input is late is
        sought with the memory alone."""
        late = {arrival: self._tried(Family(MEMORY, arrival), fold, beside) for arrival in self.bank.arrivals}
        best = min(late, key=lambda arrival: late[arrival].score)
        others = [Family(CURVE), Family(LAGGED, best), Family(TIMED, best)]
        tried = [*late.values(), *(self._tried(family, fold, beside) for family in others)]
        return min(tried, key=lambda one: one.score)

    def without(self, fold: Fold) -> Chosen:
        """The named model with nothing beside it."""
        inner = [self.targets[one.judged, 1 + one.place] for one in self.folds.inner(fold)]
        score = _mean([np.mean(left**2) for left in inner])
        return Chosen(float(score), self.targets[fold.judged, 1 + fold.place], CURVE)

    def _tried(self, family: Family, fold: Fold, beside: bool) -> Chosen:
        """With the best penalty."""
        regression = self._regression(family)

        def errors(one: Fold) -> Array:
            """By a named model that has not seen what is judged: on what it has seen it looks better than it is."""
            return regression.errors(one, 1 + one.place if beside else 0)

        scores = _mean([np.mean(errors(inner) ** 2, axis=0) for inner in self.folds.inner(fold)])
        best = int(np.argmin(scores))
        return Chosen(float(scores[best]), errors(fold)[:, best], family.level)

    def _regression(self, family: Family) -> Regression:
        if family not in self.known:
            columns = self.bank.columns(family)
            columns = columns - self._means(columns) if self.centred else columns - np.mean(columns, axis=0)
            scatter = np.std(columns, axis=0)
            columns = columns[:, scatter > 1e-9] / scatter[scatter > 1e-9]
            if not self.centred:
                columns = np.column_stack([columns, np.full(len(columns), CONSTANT)])
            self.known[family] = Regression(columns, self.targets, self.folds.part)
        return self.known[family]

    def _means(self, values: Array) -> Array:
        """Of every record, at each of its samples."""
        means = np.stack([np.mean(values[self.number == k], axis=0) for k in range(int(self.number.max()) + 1)])
        found: Array = means[self.number]
        return found


def _mean(squares: Sequence[Array]) -> Array:
    """Geometric, over the folds."""
    tiny = np.finfo(float).tiny
    mean: Array = np.exp(np.mean(np.log(np.maximum(squares, tiny)), axis=0))
    return mean

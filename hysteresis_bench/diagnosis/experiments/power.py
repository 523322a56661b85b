"""How probable is it that one record of an experiment tells two fitted systems apart?

Let y be the record, f_1 and f_2 what the two fitted systems predict for it, d = f_1 - f_2, and
V_i = s^2 I + J_i C_i J_i^T the covariance of y - f_i where system i is the true one: white noise of variance s^2, and
what the uncertainty C_i of its parameters makes of the output (J_i its Jacobian). System 2 is refuted where

    t = w^T (y - f_2) / sqrt(w^T V_2 w) > T,   w = V_2^-1 d,

the most powerful test of f_2 against f_1 [1]. Refitting system 2 to the new record beside the old ones takes up no more
than V_2 allows: |d - J_2 x|^2 / s^2 + x^T C_2^-1 x is at least d^T V_2^-1 d, whatever x. Where system 1 is true, t is
normal with mean sqrt(d^T V_2^-1 d) and variance w^T V_1 w / w^T V_2 w, which gives the power in closed form. What is
told is the mean of the powers with either of the two being true.

T is the diagnosis' own: CLEAR standard deviations, but where system 1 has more parameters than system 2. That one then
stands until the mean square over all n effective samples differs by more than ALIKE^2, which it does from t^2 =
(ALIKE^2 - 1) n on.

Assumed: one of the two is true; both are linear in their parameters within C_i; the noise of the new record is that of
the old ones. Noise that is correlated counts as white noise that is stronger, such that as many samples are worth as
little for a mean. C_i is the inverse of J^T J / s^2 over the old records, and of a uniform density over the box.

[1] J. Neyman, E. S. Pearson, Phil. Trans. R. Soc. A 231 (1933) 289.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from statistics import NormalDist

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.search.selection import ALIKE
from hysteresis_bench.fit.least_squares import errors, jacobian
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.unseen.advantage import CLEAR
from hysteresis_bench.signals import Record

BOX = 12.0
"""Inverse variance of a uniform density over the unit box, by coordinate."""


@dataclass(frozen=True)
class Left:
    """What a system leaves that is right: its RMS, above 0, and of its samples the share that are independent."""

    rms: float
    share: float = 1.0

    @property
    def heard(self) -> float:
        """Standard deviation of white noise that counts for as much."""
        return float(self.rms / np.sqrt(self.share))


@dataclass(frozen=True, eq=False)
class Fitted:
    """A system fitted to records.

    values : (dimension,), in units;  weight : samples that each of the problem's stands for, where they were thinned
    """

    problem: Problem
    values: Array
    weight: float = 1.0

    @cached_property
    def point(self) -> Array:
        """(dimension,), in the unit box."""
        return np.clip(self.problem.space.to_unit(self.values[:, None])[:, 0], 0.0, 1.0)

    @cached_property
    def squares(self) -> Array:
        """J^T J over the records, (dimension, dimension)."""
        slopes = _slopes(self.problem, self.point)
        return self.weight * slopes.T @ slopes


def told_apart(one: Fitted, other: Fitted, record: Record, left: Left) -> float:
    """The probability that the wrong one is refuted.

    record : of the experiment, as a model sees it, its output 0
    """
    first, second = (_Prediction(fitted, record, left.heard) for fitted in (one, other))
    samples = left.share * (one.problem.samples * one.weight + record.time.size)
    clear, alike = CLEAR, max(CLEAR, float(np.sqrt((ALIKE**2 - 1.0) * samples)))
    richer = one.values.size - other.values.size
    return 0.5 * (
        _power(first, second, alike if richer > 0 else clear) + _power(second, first, alike if richer < 0 else clear)
    )


class _Prediction:
    """Of one system for the new record: minus its output (samples,), and the covariance of that where it is true."""

    def __init__(self, fitted: Fitted, record: Record, noise: float) -> None:
        problem = replace(fitted.problem, records=(record,))
        self.errors = errors(problem, fitted.point[:, None])[:, 0]
        self._slopes = _slopes(problem, fitted.point)
        self._variance = noise**2
        self._information = fitted.squares / self._variance + BOX * np.eye(fitted.point.size)

    def divided(self, d: Array) -> Array:
        """V^-1 d."""
        inner = self._variance * self._information + self._slopes.T @ self._slopes
        left: Array = d - self._slopes @ np.linalg.solve(inner, self._slopes.T @ d)
        return left / self._variance

    def variance(self, w: Array) -> float:
        """w^T V w."""
        along = self._slopes.T @ w
        return float(self._variance * (w @ w) + along @ np.linalg.solve(self._information, along))


def _power(true: _Prediction, wrong: _Prediction, threshold: float) -> float:
    d = wrong.errors - true.errors
    w = wrong.divided(d)
    apart = float(d @ w)
    if apart <= 0.0:
        return 0.0
    spread = np.sqrt(true.variance(w) / apart)
    return NormalDist().cdf((np.sqrt(apart) - threshold) / float(spread))


def _slopes(problem: Problem, point: Array) -> Array:
    """Derivatives of the errors by the unit box's coordinates, (samples, dimension)."""
    return jacobian(problem, point[:, None])[1][:, 0, :]

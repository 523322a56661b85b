"""Regression whose errors are autocorrelated, so that n samples are not taken for n independent ones.

The errors are taken for an autoregression (order by BIC), errors and columns are filtered to make them white
(Cochrane and Orcutt [1]), and an F test compares the regressions with and without the columns in question.
Its degrees of freedom are those of the effective sample size (Geyer's initial positive sequence [2]), ours:
with few effective samples the autoregression is itself uncertain, and the plain F test claims too much.
Whether errors are as loud in one stretch as in another, Bartlett's test [3] says, with degrees of freedom alike.

A residual and its columns are lists, one array a record: filters and lags never reach across records.

[1] D. Cochrane, G. H. Orcutt, J. Am. Stat. Assoc. 44 (1949) 32.  [2] C. J. Geyer, Stat. Sci. 7 (1992) 473.
[3] M. S. Bartlett, Proc. R. Soc. A 160 (1937) 268.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array

Parts = Sequence[Array]

MOST_ORDERS = 12
"""Of the autoregression that errors follow, among which BIC chooses."""

FEWEST_DEGREES = 4.0
"""Degrees of freedom of an F test below, at least: the estimate of their number is rough."""
STRETCH, STRETCHES = 8.0, 4
"""Degrees of freedom of the mean square of a stretch, from which its logarithm is nearly normal, and how many stretches
there must be. Of 40 residuals of four records with bursts as loud as the noise it finds 37, with half of the former 40,
with twice 2; louder ones all with each, and none in 450 that are as loud throughout. Of the latter half and twice are
alike."""
TINY = 1e-12
"""Below this share of the sum of squares lies only rounding."""


@dataclass(frozen=True)
class FTest:
    """Do the columns explain the residual? share : of its variance, by least squares."""

    statistic: float
    p: float
    share: float


def autoregression(errors: Parts) -> Array:
    """Coefficients a_1..a_p of e_i = sum a_j e_(i-j) + white, order by BIC, pooled over the records."""
    top = min(MOST_ORDERS, min(error.size for error in errors) // 10)
    if top < 1:
        return np.zeros(0)
    lagged = [np.column_stack([error[top - j : error.size - j] for j in range(top + 1)]) for error in errors]
    product = np.sum([part.T @ part for part in lagged], axis=0)
    samples = sum(part.shape[0] for part in lagged)
    if product[0, 0] <= 0:
        return np.zeros(0)
    best, chosen = samples * np.log(product[0, 0] / samples), np.zeros(0)
    for order in range(1, top + 1):
        inside = slice(1, order + 1)
        coefficients = np.linalg.lstsq(product[inside, inside], product[inside, 0], rcond=1e-12)[0]
        left = product[0, 0] - coefficients @ product[inside, 0]
        criterion = samples * np.log(max(left, TINY * product[0, 0]) / samples) + order * np.log(samples)
        if criterion < best:
            best, chosen = criterion, coefficients
    return chosen


def whitened(values: Parts, coefficients: Array) -> list[Array]:
    """Each record's (samples,) or (samples, columns) filtered by 1 - sum a_j B^j; the first p samples are lost."""
    order = coefficients.size
    return [
        value[order:] - sum((a * value[order - j : len(value) - j] for j, a in enumerate(coefficients, 1)), 0.0)
        for value in values
    ]


def lagged_products(e: Array) -> Array:
    """sum_i e_i e_(i+k) at lags k of 0..n-1."""
    from scipy.fft import next_fast_len

    padded = next_fast_len(2 * e.size, real=True)  # twice as long, so that the end does not meet the beginning
    products: Array = np.fft.irfft(np.abs(np.fft.rfft(e, padded)) ** 2, padded)[: e.size]
    return products


def correlations(errors: Parts) -> Array:
    """Autocorrelation at lags 0..n/2 of the shortest record, pooled; 1 at lag 0. Means are not taken off."""
    length = max(2, min(error.size for error in errors) // 2)
    total = np.sum([lagged_products(error)[:length] for error in errors], axis=0)
    found: Array = total / total[0] if total[0] > 0 else np.eye(1, length)[0]
    return found


def effective_samples(errors: Parts) -> float:
    """How many independent samples the errors are worth for a mean; at most their number."""
    correlation = correlations(errors)
    pairs = correlation[: correlation.size // 2 * 2].reshape(-1, 2).sum(axis=1)
    ends = np.nonzero(pairs <= 0)[0]
    positive = np.minimum.accumulate(pairs[: ends[0] if ends.size else pairs.size])
    samples = sum(error.size for error in errors)
    return float(samples / max(2.0 * positive.sum() - 1.0, 1.0))


def equally_loud(errors: Parts) -> float:
    """p-value of stretches that are as loud as each other; 1 where the errors are too few, or correlated too far, for
    four of them.

    Of autocorrelated normal errors the mean square of n has n / sum_{|k|<n} (1 - |k|/n) r_k^2 degrees of freedom.
    """
    from scipy.special import chdtrc

    squares = correlations(errors) ** 2
    lags = np.arange(squares.size)
    sizes = lags + 1
    freedom = sizes / (2.0 * np.cumsum(squares) - 2.0 * np.cumsum(lags * squares) / sizes - squares[0])
    enough = np.flatnonzero(freedom >= STRETCH)
    if not enough.size:
        return 1.0
    size = int(sizes[enough[0]])
    stretches = [part for error in errors for part in np.array_split(error, max(error.size // size, 1))]
    stretches = [part for part in stretches if part.size >= size]
    loud = np.array([float(np.mean(part**2)) for part in stretches])
    if loud.size < STRETCHES or not np.all(loud > 0.0):
        return 1.0
    own = freedom[np.minimum([part.size for part in stretches], sizes.size) - 1]
    statistic = own.sum() * np.log(own @ loud / own.sum()) - own @ np.log(loud)  # [3]
    corrected = statistic / (1.0 + (np.sum(1.0 / own) - 1.0 / own.sum()) / (3.0 * (loud.size - 1)))
    return float(chdtrc(loud.size - 1, corrected))


def f_test(errors: Parts, columns: Parts, nuisance: Parts | None = None, level: bool = True) -> FTest:
    """errors : (samples,) a record; columns, nuisance : (samples, any) a record.

    nuisance : columns that the errors may depend on anyhow; with `level`, so may each record's mean
    """
    apart = constants(errors) if level else [np.zeros((error.size, 0)) for error in errors]
    if nuisance is not None:
        apart = [np.column_stack([one, other]) for one, other in zip(apart, nuisance, strict=True)]
    e, z, x = np.concatenate(list(errors)), np.concatenate(apart), np.concatenate(list(columns))
    before, rank_before = _squares(e, z)
    after, rank_after = _squares(e, np.column_stack([z, x]))
    added = rank_after - rank_before
    if added == 0 or before <= TINY * TINY * max(e @ e, 1e-300):
        return FTest(0.0, 1.0, 0.0)
    share = max(0.0, 1.0 - after / before)
    left = split(left_over(e, np.column_stack([z, x])), errors)
    coefficients = autoregression(left)
    e, z, x = (np.concatenate(whitened(part, coefficients)) for part in (list(errors), apart, list(columns)))
    white_before, rank_before = _squares(e, z)
    white_after, rank_after = _squares(e, np.column_stack([z, x]))
    added = rank_after - rank_before
    if added == 0:
        return FTest(0.0, 1.0, share)
    freedom = e.size - rank_after
    statistic = (white_before - white_after) / added / max(white_after / freedom, TINY * white_before / freedom)
    # The columns took their share of the slow part of the errors, which the autoregression then misses.
    effective = effective_samples(left)
    corrected = statistic * effective / (effective + 2.0 * rank_after)
    return FTest(float(statistic), f_tail(corrected, added, effective - rank_after), share)


def f_tail(statistic: float, above: float, below: float) -> float:
    """P(F > statistic), with at least `FEWEST_DEGREES` degrees of freedom below."""
    from scipy.special import fdtrc

    return float(fdtrc(above, max(below, FEWEST_DEGREES), max(statistic, 0.0)))


def overlooked(effective: float, columns: int, level: float) -> float:
    """Share of the variance that so many columns explain of so many effective samples where the F test of `f_test` just
    passes at a level: a dependence of less may be there unseen. 1 where there are too few samples for a test."""
    from scipy.special import fdtri

    freedom = effective - columns - 1.0  # each test leaves a mean free
    if freedom <= 0.0:
        return 1.0
    passing = float(fdtri(columns, max(freedom, FEWEST_DEGREES), 1.0 - level))
    ratio = passing * (effective + 2.0 * (columns + 1.0)) / effective * columns / freedom
    return ratio / (1.0 + ratio)


def constants(errors: Parts) -> list[Array]:
    """One column a record: 1 inside it, 0 elsewhere."""
    return [np.tile(row, (error.size, 1)) for row, error in zip(np.eye(len(errors)), errors, strict=True)]


def split(joined: Array, like: Parts) -> list[Array]:
    """Cut what was concatenated back into records."""
    return np.split(joined, np.cumsum([len(part) for part in like])[:-1])


def left_over(e: Array, columns: Array) -> Array:
    """What least squares leaves of e."""
    basis = _basis(columns)
    left: Array = e - basis @ (basis.T @ e)
    return left


def _squares(e: Array, columns: Array) -> tuple[float, int]:
    basis = _basis(columns)
    left = e - basis @ (basis.T @ e)
    return float(left @ left), basis.shape[1]


def _basis(columns: Array) -> Array:
    """Orthonormal basis of the columns' span; columns that say the same as others are dropped."""
    size = np.linalg.norm(columns, axis=0)
    scaled = columns[:, size > 0] / size[size > 0]
    if scaled.shape[1] == 0:
        return np.zeros((len(columns), 0))
    vectors, values, _ = np.linalg.svd(scaled, full_matrices=False)
    return vectors[:, values > 1e-7 * values[0]]

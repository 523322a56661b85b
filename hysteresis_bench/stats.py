"""Statistics of repeated trials: tests, effect sizes, ECDF, ERT. Arrays in, numbers out.

Lower is better throughout. A trial that failed is +inf and so ranks as worst; two failures tie. No answer
is NaN: identical samples give p = 1 and A12 = 0.5. Below ENOUGH trials a test answers p = None, because a
handful of pairs cannot tell.

[1] M. Friedman, J. Am. Stat. Assoc. 32 (1937) 675.  [2] F. Wilcoxon, Biometrics Bull. 1 (1945) 80;
J. W. Pratt, J. Am. Stat. Assoc. 54 (1959) 655 (zero differences).  [3] S. Holm, Scand. J. Stat. 6 (1979) 65.
[4] A. Vargha, H. D. Delaney, J. Educ. Behav. Stat. 25 (2000) 101.  [5] E. B. Wilson, J. Am. Stat. Assoc. 22
(1927) 209.  [6] N. Hansen et al., COCO, Optim. Methods Softw. 36 (2021) 114 (ERT, ECDF).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array

ENOUGH = 14
"""Trials below which no p-value is given."""

LEVEL = 0.05
"""Level of significance, after Holm's correction."""

TOO_FEW = "too few trials to tell"
SAME = "we cannot tell these two apart"


@dataclass(frozen=True)
class Comparison:
    """One sample against another, lower is better.

    p : two-sided and corrected where several were compared; None below ENOUGH pairs
    a12 : how often a value of ours is the lower one, ties half; above 0.5 is better
    """

    p: float | None
    a12: float

    @property
    def significant(self) -> bool:
        return self.p is not None and self.p < LEVEL

    @property
    def words(self) -> str:
        """better, worse, SAME or TOO_FEW; the size of the effect in words where there is one."""
        if self.p is None:
            return TOO_FEW
        if not self.significant or self.a12 == 0.5:
            return SAME
        return f"{'better' if self.a12 > 0.5 else 'worse'} ({magnitude(self.a12)} effect)"


def magnitude(a12: float) -> str:
    """A12 in words, thresholds of [4]: 0.56 small, 0.64 medium, 0.71 large."""
    distance = abs(a12 - 0.5)
    return next(word for edge, word in ((0.21, "large"), (0.14, "medium"), (0.06, "small"), (-1.0, "negligible"))
                if distance >= edge - 1e-12)  # fmt: skip


def a12(ours: ArrayLike, theirs: ArrayLike) -> float:
    """[4] P(ours < theirs) + P(equal) / 2 over all pairs; inf is a failed trial. 0.5 where one is empty."""
    x, y = np.asarray(ours, dtype=float)[:, None], np.asarray(theirs, dtype=float)[None, :]
    if x.size == 0 or y.size == 0:
        return 0.5
    return float(np.mean(x < y) + 0.5 * np.mean(x == y))


def wilcoxon(ours: ArrayLike, theirs: ArrayLike) -> float:
    """[2] Two-sided signed-rank p of paired samples, (trials,) each; zero differences after Pratt.

    A pair with one failure is the largest difference there is; a pair of failures is a tie.
    """
    from scipy import stats

    x, y = np.asarray(ours, dtype=float), np.asarray(theirs, dtype=float)
    differences = np.subtract(x, y, out=np.zeros(x.shape), where=x != y)
    finite = np.isfinite(differences)
    beyond = 2.0 * np.max(np.abs(differences[finite]), initial=0.0) + 1.0
    differences = np.where(finite, differences, np.sign(differences) * beyond)
    if not np.any(differences):
        return 1.0
    return float(stats.wilcoxon(differences, zero_method="pratt").pvalue)


def holm(p: Sequence[float]) -> list[float]:
    """[3] Step-down corrected p-values, in the order given."""
    values = np.asarray(p, dtype=float)
    order = np.argsort(values, kind="stable")
    factors = values.size - np.arange(values.size)
    corrected = np.empty_like(values)
    corrected[order] = np.minimum(np.maximum.accumulate(values[order] * factors), 1.0)
    return [float(value) for value in corrected]


def compare(samples: Sequence[ArrayLike], with_one: ArrayLike) -> list[Comparison]:
    """Each sample against one, paired by trial, Holm-corrected over the family.

    samples : (trials,) each, and `with_one` (trials,): the same trials in the same order
    """
    theirs = np.asarray(with_one, dtype=float)
    effects = [a12(ours, theirs) for ours in samples]
    if theirs.size < ENOUGH:
        return [Comparison(None, effect) for effect in effects]
    corrected = holm([wilcoxon(ours, theirs) for ours in samples])
    return [Comparison(p, effect) for p, effect in zip(corrected, effects, strict=True)]


@dataclass(frozen=True)
class Friedman:
    """Do any of the samples differ? mean_ranks in the order given, 1 is best."""

    statistic: float
    p: float | None
    mean_ranks: list[float]


def friedman(samples: Sequence[ArrayLike]) -> Friedman:
    """[1] Blocks are the trials. samples : k of (trials,), the same trials in the same order."""
    from scipy import stats

    blocks = np.array([np.asarray(sample, dtype=float) for sample in samples]).T  # (trials, k)
    trials, k = blocks.shape
    ranks = np.array([stats.rankdata(block) for block in blocks]).reshape(trials, k)
    mean_ranks = [float(rank) for rank in ranks.mean(axis=0)] if trials else [float("nan")] * k
    varies = trials > 0 and bool(np.any(ranks != ranks[:, :1]))
    if k < 3 or trials < ENOUGH:
        return Friedman(0.0, None, mean_ranks)
    if not varies:
        return Friedman(0.0, 1.0, mean_ranks)
    statistic, p = stats.friedmanchisquare(*ranks.T)
    return Friedman(float(statistic), float(p), mean_ranks)


def quantile(values: ArrayLike, q: float) -> float:
    """Linear quantile that knows inf: between a finite value and a failure lies a failure. inf if empty."""
    x = np.sort(np.asarray(values, dtype=float))
    if x.size == 0:
        return float("inf")
    position = q * (x.size - 1)
    low, share = int(position), position - int(position)
    if share == 0.0 or x[low] == x[low + 1]:
        return float(x[low])
    return float(x[low] + share * (x[low + 1] - x[low]))


def wilson(successes: int, trials: int, z: float = 1.959963984540054) -> tuple[float, float]:
    """[5] 95 % interval of a success rate; (0, 1) without trials."""
    if trials == 0:
        return 0.0, 1.0
    rate, spread = successes / trials, z * z / trials
    centre = (rate + spread / 2.0) / (1.0 + spread)
    half = z * np.sqrt(rate * (1.0 - rate) / trials + spread / (4.0 * trials)) / (1.0 + spread)
    return max(0.0, float(centre - half)), min(1.0, float(centre + half))


def expected_running_time(to_target: ArrayLike, spent: ArrayLike) -> float:
    """[6] Evaluations spent by all trials up to their target (or their end), for each success. inf without one.

    to_target : (trials,) evaluations to the target, inf where it was not reached
    spent : (trials,) evaluations of the whole trial
    """
    reached, total = np.asarray(to_target, dtype=float), np.asarray(spent, dtype=float)
    successes = int(np.count_nonzero(np.isfinite(reached)))
    if successes == 0:
        return float("inf")
    return float(np.sum(np.where(np.isfinite(reached), reached, total)) / successes)


def ecdf(to_target: ArrayLike, at: ArrayLike) -> Array:
    """[6] Share of targets reached after so many evaluations. to_target : any shape, inf where not reached;
    at : (points,) -> (points,) in [0, 1]."""
    reached = np.sort(np.asarray(to_target, dtype=float), axis=None)
    share: Array = np.searchsorted(reached, np.asarray(at, dtype=float), side="right") / max(reached.size, 1)
    return share

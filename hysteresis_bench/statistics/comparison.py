"""One sample against another: p, effect size, practical equivalence, and the verdict that follows from the three."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.statistics.effect_size import a12_interval, magnitude
from hysteresis_bench.statistics.equivalence import REGION, Practical, practical
from hysteresis_bench.statistics.ranks import ENOUGH, LEVEL, SignedRank, holm, signed_rank

TOO_FEW = "too few trials to tell"
SAME = "we cannot tell these two apart"
AT_ODDS = "we cannot tell which is better: the signed-rank test favours one, and A12 does not"
BETTER, EQUIVALENT, WORSE, CANNOT_TELL = "better", "equivalent", "worse", "cannot tell"

SURE = 0.95
"""Probability from which two are equivalent."""

TIE = 1e-6
"""Logarithms, so values, that differ by less are equal: they differ by rounding."""


@dataclass(frozen=True, eq=False)
class Sample:
    """What trials came to, as logarithms; lower is better, inf failed.

    instances : an array of trials an instance; what is compared has the same instances and trials in the same order
    measured : the same for the quantity that equivalence is judged on, where it is another one
    """

    instances: tuple[Array, ...]
    measured: tuple[Array, ...] = ()

    @property
    def blocks(self) -> Array:
        """(blocks,): the medians of the instances; of a single instance its trials."""
        return _blocks(self.instances)

    @property
    def practical(self) -> Array:
        """(blocks,) of what equivalence is judged on."""
        return _blocks(self.measured or self.instances)


def _blocks(instances: tuple[Array, ...]) -> Array:
    if len(instances) == 1:
        return instances[0]
    return np.array([np.median(trials) if trials.size else np.inf for trials in instances])


@dataclass(frozen=True)
class Comparison:
    """One sample against another, lower is better.

    p : two-sided and corrected where several were compared; None below ENOUGH blocks
    a12 : how often a value of ours is the lower one, ties half; above 0.5 is better;  low, high : its 95 % interval
    practical : probabilities of better, equivalent and worse; None below ENOUGH blocks
    favours : the side of the test that gave p: 1 ours, -1 theirs, 0 none
    """

    p: float | None
    a12: float
    low: float = 0.0
    high: float = 1.0
    practical: Practical | None = None
    favours: int = 0

    @property
    def significant(self) -> bool:
        return self.p is not None and self.p < LEVEL

    @property
    def at_odds(self) -> bool:
        """Whether the test tells two apart and A12 does not have the same one as the better: many small wins, say,
        and a few large losses. Both were asked which one is lower, and the answer hangs on how it is asked."""
        return self.significant and self.favours * (self.a12 - 0.5) <= 0.0

    @property
    def verdict(self) -> str:
        """BETTER, EQUIVALENT, WORSE or CANNOT_TELL. A difference that is proved and too small to matter is none."""
        if self.practical and self.practical.equivalent >= SURE:
            return EQUIVALENT
        if not self.significant or self.at_odds:
            return CANNOT_TELL
        return BETTER if self.favours > 0 else WORSE

    @property
    def words(self) -> str:
        """The verdict with the size of the effect; SAME, AT_ODDS or TOO_FEW where there is none."""
        if self.p is None:
            return TOO_FEW
        if self.verdict == CANNOT_TELL:
            return AT_ODDS if self.at_odds else SAME
        return EQUIVALENT if self.verdict == EQUIVALENT else f"{self.verdict} ({magnitude(self.a12)} effect)"


def compare(samples: Sequence[Sample], with_one: Sample, region: float = REGION) -> list[Comparison]:
    """Each sample against one, Holm-corrected over the family."""
    return compare_pairs([(sample, with_one) for sample in samples], region)


def compare_pairs(
    pairs: Sequence[tuple[Sample, Sample]], region: float = REGION, tested: Sequence[SignedRank] | None = None
) -> list[Comparison]:
    """Ours against theirs, a pair at a time, Holm-corrected over all of them.

    tested : the tests of these pairs, where they are corrected over a larger family, see `every_pair`
    """
    effects = [a12_interval(ours.instances, theirs.instances, TIE) for ours, theirs in pairs]
    if not pairs or pairs[0][0].blocks.size < ENOUGH:
        return [Comparison(None, *effect) for effect in effects]
    return [
        Comparison(test.p, *effect, practical(ours.practical, theirs.practical, region), test.favours)
        for test, effect, (ours, theirs) in zip(tested or _tested(pairs), effects, pairs, strict=True)
    ]


def every_pair(samples: Mapping[str, Sample]) -> dict[tuple[str, str], SignedRank]:
    """Each sample against each other one, by both their names, Holm-corrected over all pairs: the family of a
    comparison with one that these same data chose, such as the best of them."""
    names = list(combinations(samples, 2))
    found = dict(zip(names, _tested([(samples[one], samples[other]) for one, other in names]), strict=True))
    return found | {(other, one): test.mirrored for (one, other), test in found.items()}


def _tested(pairs: Sequence[tuple[Sample, Sample]]) -> list[SignedRank]:
    """The signed-rank tests, Holm-corrected over these pairs."""
    found = [signed_rank(ours.blocks, theirs.blocks, TIE) for ours, theirs in pairs]
    corrected = holm([test.p for test in found])
    return [SignedRank(p, test.favours) for p, test in zip(corrected, found, strict=True)]

"""How often are two equal optimizers called different, where results are not as a test would like them?

    python -m benchmarks.error_rates

Every kind of results is drawn alike for both optimizers, so that whoever is called better is so by chance; then once
more with the second one worse by SHIFT. STUDIES studies of 20 instances with 2 trials each. 5 % may be called
different, and by chance up to 6.4 % of 1000 studies.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.random import Generator

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array

INSTANCES, TRIALS, STUDIES, SHIFT = 20, 2, 1000, 0.1
SPREAD = 0.05

Drawn = Callable[[Generator, tuple[int, int]], Array]
"""Logarithms of errors about an instance's difficulty, (instances, trials)."""


def normal(rng: Generator, size: tuple[int, int]) -> Array:
    return SPREAD * rng.standard_normal(size)


def cauchy(rng: Generator, size: tuple[int, int]) -> Array:
    """Tails without a variance."""
    return SPREAD * rng.standard_cauchy(size)


def skewed(rng: Generator, size: tuple[int, int]) -> Array:
    """Most near the best, some far off."""
    return np.abs(SPREAD * rng.standard_cauchy(size))


def two_optima(rng: Generator, size: tuple[int, int]) -> Array:
    """A third of the searches ends in a local optimum three times as bad; all but rounding is equal within each."""
    return np.where(rng.random(size) < 1 / 3, np.log(3.0), 0.0) + 1e-9 * rng.standard_normal(size)


def mostly_tied(rng: Generator, size: tuple[int, int]) -> Array:
    """On four instances of five every search finds the same, to the last bit."""
    hard = rng.permutation(size[0]) < size[0] // 5
    return np.where(hard[:, None], SPREAD * rng.standard_normal(size), 0.0)


def rounded(rng: Generator, size: tuple[int, int]) -> Array:
    """To a grid as coarse as the spread: most differences are 0 or one step."""
    return SPREAD * np.round(rng.standard_normal(size))


def deterministic(rng: Generator, size: tuple[int, int]) -> Array:
    """Every trial on an instance is the same again."""
    return np.repeat(SPREAD * rng.standard_normal((size[0], 1)), size[1], axis=1)


def censored(rng: Generator, size: tuple[int, int]) -> Array:
    """A fifth of the trials fails."""
    return np.where(rng.random(size) < 0.2, np.inf, normal(rng, size))


def unlike_instances(rng: Generator, size: tuple[int, int]) -> Array:
    """Trials spread by 0.05 % on one instance and by a factor of several on another."""
    return np.exp(rng.normal(-3.0, 2.0, (size[0], 1))) * rng.standard_normal(size)


KINDS: dict[str, tuple[Drawn, Drawn]] = {
    "lognormal": (normal, normal),
    "heavy tails": (cauchy, cauchy),
    "heavy tails to one side": (skewed, skewed),
    "two optima": (two_optima, two_optima),
    "tied on 4 instances of 5": (mostly_tied, mostly_tied),
    "on a coarse grid": (rounded, rounded),
    "deterministic": (deterministic, deterministic),
    "a fifth failed": (censored, censored),
    "unlike instances": (unlike_instances, unlike_instances),
    "the one spreads 10 times": (normal, lambda rng, size: 10.0 * normal(rng, size)),
    "same median, other shape": (normal, lambda rng, size: SPREAD * (rng.standard_exponential(size) - np.log(2.0))),
}


def pair(
    rng: Generator, kinds: tuple[Drawn, Drawn], *, instances: int = INSTANCES, trials: int = TRIALS, shift: float = 0.0
) -> tuple[statistics.Sample, statistics.Sample]:
    """The second optimizer, worse by the shift, then the first."""
    difficulty = rng.normal(0.0, 3.0, (instances, 1))
    first, second = (difficulty + kind(rng, (instances, trials)) for kind in kinds)
    return statistics.Sample(tuple(second + np.log1p(shift))), statistics.Sample(tuple(first))


def told_apart(ours: statistics.Sample, theirs: statistics.Sample) -> bool:
    """As `statistics.compare_pairs` says it; the slow half of it is asked only where the answer hangs on it."""
    test = statistics.signed_rank(ours.blocks, theirs.blocks, statistics.TIE)
    if test.p >= statistics.LEVEL:
        return False
    differences = statistics.ranks.differences(ours.practical, theirs.practical)
    averages = 0.5 * (differences[:, None] + differences[None, :])
    if np.mean(np.abs(averages) <= statistics.REGION) < 0.1:  # too few for the region to be favoured
        return test.favours * (statistics.mean_a12(ours.instances, theirs.instances, statistics.TIE) - 0.5) > 0.0
    return statistics.compare_pairs([(ours, theirs)])[0].verdict in ("better", "worse")


def share_told_apart(
    kinds: tuple[Drawn, Drawn], *, studies: int, shift: float = 0.0, seed: int = 1, instances: int = INSTANCES
) -> float:
    """Of simulated studies."""
    rng = np.random.default_rng(seed)
    return float(np.mean([told_apart(*pair(rng, kinds, instances=instances, shift=shift)) for _ in range(studies)]))


def share_of_families(others: int, *, studies: int, seed: int = 1) -> float:
    """Of studies in which any of so many optimizers, all equal, is told apart from the reference after Holm."""
    rng = np.random.default_rng(seed)
    wrong = 0
    for _ in range(studies):
        difficulty = rng.normal(0.0, 3.0, (INSTANCES, 1))
        every = [difficulty + cauchy(rng, (INSTANCES, TRIALS)) for _ in range(others + 1)]
        reference, *rest = (np.median(each, axis=1) for each in every)
        found = statistics.holm([statistics.wilcoxon(each, reference, statistics.TIE) for each in rest])
        wrong += min(found) < statistics.LEVEL
    return wrong / studies


def main() -> None:
    print(f"{'results':26} {'equal':>7} {'worse by 10 %':>14} {'equal, 14 instances':>20}")
    for name, kinds in KINDS.items():
        equal = share_told_apart(kinds, studies=STUDIES)
        power = share_told_apart(kinds, studies=STUDIES // 5, shift=SHIFT)
        few = share_told_apart(kinds, studies=STUDIES, instances=statistics.ENOUGH)
        print(f"{name:26} {equal:7.3f} {power:14.3f} {few:20.3f}", flush=True)
    print(f"any of 10 equal ones, heavy tails, after Holm: {share_of_families(10, studies=STUDIES):.3f}")


if __name__ == "__main__":
    main()

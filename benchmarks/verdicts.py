"""How often are verdicts over instances right? Simulated studies of two optimizers whose difference is known.

    python -m benchmarks.verdicts

Every instance has its own difficulty, a factor of e either way; a trial's error is lognormal about it. The second
optimizer's errors are larger by `shift`. The families are of one comparison.
"""

from __future__ import annotations

import itertools
from collections import Counter

import numpy as np
from numpy.random import Generator

from hysteresis_bench import statistics

VERDICTS = ("better", "equivalent", "worse", "cannot tell")


def study(
    rng: Generator, *, instances: int, trials: int, shift: float, spread: float
) -> tuple[statistics.Sample, statistics.Sample]:
    """Logarithms of the errors of the second optimizer, then of the first."""
    difficulty = rng.normal(0.0, 1.0, (instances, 1))
    first, second = (difficulty + spread * rng.standard_normal((instances, trials)) for _ in range(2))
    return statistics.Sample(tuple(second + np.log1p(shift))), statistics.Sample(tuple(first))


def verdicts(
    *, studies: int, shift: float, spread: float, instances: int = 20, trials: int = 2, seed: int = 1
) -> dict[str, float]:
    """Shares of the verdicts on the second optimizer."""
    rng = np.random.default_rng(seed)
    found: Counter[str] = Counter()
    for _ in range(studies):
        pair = study(rng, instances=instances, trials=trials, shift=shift, spread=spread)
        found[statistics.compare_pairs([pair])[0].verdict] += 1
    return {verdict: found[verdict] / studies for verdict in VERDICTS}


def main() -> None:
    """A line a setting, of 1000 studies each with 20 instances of 2 trials."""
    names = "  ".join(f"{name:>11}" for name in VERDICTS)
    print(f"{'spread':>6} {'shift':>6}  {names}")
    for spread, shift in itertools.product((0.002, 0.05, 0.3), (0.0, 0.005, 0.02, 0.05, 0.1, 0.3)):
        found = verdicts(studies=1000, shift=shift, spread=spread)
        shares = "  ".join(f"{found[name]:>11.3f}" for name in VERDICTS)
        print(f"{spread:>6} {shift:>6}  {shares}", flush=True)


if __name__ == "__main__":
    main()

"""Numbers that describe trials: quantiles that know failures, success rates, expected running time, ECDF.

[1] E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209.
[2] N. Hansen et al., COCO, Optim. Methods Softw. 36 (2021) 114 (ERT, ECDF).
[3] C. J. Clopper, E. S. Pearson, Biometrika 26 (1934) 404.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from hysteresis_bench.arrays import Array


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


def wilson(successes: float, trials: int, z: float = 1.959963984540054) -> tuple[float, float]:
    """[1] 95 % interval of a success rate; (0, 1) without trials.

    successes : a fraction where the trials are blocks, each with a rate of its own
    """
    if trials == 0:
        return 0.0, 1.0
    rate, spread = successes / trials, z * z / trials
    centre = (rate + spread / 2.0) / (1.0 + spread)
    half = z * np.sqrt(rate * (1.0 - rate) / trials + spread / (4.0 * trials)) / (1.0 + spread)
    return max(0.0, float(centre - half)), min(1.0, float(centre + half))


def clopper_pearson(successes: float, trials: float, level: float = 0.95) -> tuple[float, float]:
    """[3] Interval of a success rate that holds it at least as often as the level says; (0, 1) without trials.

    successes, trials : need not be whole, where trials are as much worth as so many independent ones
    """
    from scipy.special import betaincinv

    tail, failures = 0.5 * (1.0 - level), max(trials - successes, 0.0)
    low = float(betaincinv(successes, failures + 1.0, tail)) if successes > 0.0 else 0.0
    return low, float(betaincinv(successes + 1.0, failures, 1.0 - tail)) if failures > 0.0 else 1.0


def expected_running_time(to_target: ArrayLike, spent: ArrayLike) -> float:
    """[2] Evaluations spent by all trials up to their target (or their end), for each success. inf without one.

    to_target : (trials,) evaluations to the target, inf where it was not reached
    spent : (trials,) evaluations of the whole trial
    """
    reached, total = np.asarray(to_target, dtype=float), np.asarray(spent, dtype=float)
    successes = int(np.count_nonzero(np.isfinite(reached)))
    if successes == 0:
        return float("inf")
    return float(np.sum(np.where(np.isfinite(reached), reached, total)) / successes)


def ecdf(to_target: ArrayLike, at: ArrayLike) -> Array:
    """[2] Share of targets reached after so many evaluations. to_target : any shape, inf where not reached;
    at : (points,) -> (points,) in [0, 1]."""
    reached = np.sort(np.asarray(to_target, dtype=float), axis=None)
    share: Array = np.searchsorted(reached, np.asarray(at, dtype=float), side="right") / max(reached.size, 1)
    return share

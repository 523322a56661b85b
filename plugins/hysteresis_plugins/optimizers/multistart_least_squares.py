"""Levenberg-Marquardt from many low-discrepancy points at once, until the best optimum was found twice.

[1] M. Roberts, The unreasonable effectiveness of quasirandom sequences (2018): a Kronecker sequence whose steps are
    the inverse powers of the generalized golden ratio.
[2] A. H. G. Rinnooy Kan, G. T. Timmer, Stochastic global optimization methods, Mathematical Programming 39 (1987)
    27: descents from the best of a sample, and a stop by how often an optimum was found.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import at_least

FIRST_POINTS = 8
"""Of those that all optimizers share: what a typical loss is."""
TWICE = 1e-4
"""Two descents have found the same optimum when their losses differ by less than this share."""
NOTHING_LEFT = 1e-9
"""Share of a typical first loss below which there is nothing left to find."""
APART = 0.05
"""Largest distance along an axis of the unit box by which two starts of a round differ at least."""
FIRST, LAST = 4, 40
"""Iterations of all descents of a round, then of the best ones."""
ROUGH, EXACT = 1e-2, 1e-5
"""Relative fall of the loss by which the former and the latter end."""


@dataclass(frozen=True)
class MultistartLeastSquares(Optimizer):
    """Multistart least squares (ours): Levenberg-Marquardt with the swarm's Jacobian, from low-discrepancy points.

    points : low-discrepancy points of a round [1], simulated as one swarm
    descents : of the best of them that lie apart, some iterations each;  finished : of these, followed to their end

    Rounds follow until the best loss was reached twice, from different starts, or until the budget is spent. Bounds:
    every step is the least of its quadratic problem in the box. Parameters in which the output is linear are
    eliminated at the start of a round. Every simulation counts, those of finite differences too.
    """

    points: int = 128
    descents: int = 4
    finished: int = 2

    def __post_init__(self) -> None:
        at_least(1, points=self.points, descents=self.descents, finished=self.finished)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        typical = float(np.median(objective.many(start(FIRST_POINTS))))
        arrived: list[float] = []
        while True:
            points, squares = _screened(objective, self.points, rng)
            starts = points[:, _apart(points, squares, self.descents)]
            began = float(objective.many(starts).min())
            rough, losses = _descend(objective, starts, FIRST, ROUGH)
            best = rough[:, np.argsort(losses, kind="stable")[: self.finished]]
            _, losses = _descend(objective, best, LAST, EXACT)
            # a descent that never moved has found nothing, as in a box where nothing can be simulated
            moved = losses < began
            arrived += losses[moved | (len(objective.linear) == objective.dimension)].tolist()
            if _found_twice(arrived) or min(arrived, default=np.inf) < NOTHING_LEFT * typical:
                return


def _screened(objective: Objective, count: int, rng: Generator) -> tuple[Array, Array]:
    """Points (dimension, n) of a round, for at most `count` evaluations, and what rises with their losses.

    Half as many evaluations where coordinates are eliminated, as fewer are left to be filled with points.
    """
    if not objective.linear:
        points = _spread(objective.dimension, count, rng)
        return points, objective.many(points)
    from hysteresis_bench.kernels.variable_projection import eliminate

    fewer = max(1, count // 2 // (len(objective.linear) + 1)) if len(objective.linear) < objective.dimension else 1
    return eliminate(objective.residual_swarm, _spread(objective.dimension, fewer, rng), objective.linear)


def _spread(dimension: int, count: int, rng: Generator) -> Array:
    """(dimension, count) points that fill the unit box evenly, shifted at random [1]."""
    golden = 2.0
    for _ in range(64):
        golden = (1.0 + golden) ** (1.0 / (dimension + 1.0))
    steps = golden ** -np.arange(1.0, dimension + 1.0)
    points: Array = (rng.random((dimension, 1)) + steps[:, None] * np.arange(count)) % 1.0
    return points


def _apart(points: Array, losses: Array, count: int) -> list[int]:
    """Columns of the least losses, unlike each other."""
    chosen: list[int] = []
    for column in np.argsort(losses, kind="stable").tolist():
        if len(chosen) == count:
            break
        if not chosen or np.all(np.max(np.abs(points[:, chosen] - points[:, [column]]), axis=0) > APART):
            chosen.append(column)
    return chosen


def _descend(objective: Objective, starts: Array, iterations: int, converged: float) -> tuple[Array, Array]:
    from hysteresis_bench.kernels.levenberg_marquardt import descend

    return descend(
        lambda points, _: objective.residual_swarm(points),
        lambda points, _: objective.many(points),
        starts,
        iterations=iterations,
        converged=converged,
    )


def _found_twice(losses: list[float]) -> bool:
    best, second, *_ = [*sorted(losses), np.inf, np.inf]
    return second < best * (1.0 + TWICE)

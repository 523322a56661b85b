"""Does the data need hysteresis at all? Laws without branches against the same laws with branches.

Without: the laws of `memoryless`. With: the same, and columns whose value depends on past extrema and not on
time: play operators, the branch, the distance from the last turning point. Each record has its own offset and
slope in time. Both are judged on blocks of samples that they were not fitted to.

Hysteresis is needed only where branches predict significantly better and by an amount that matters: what they
explain is at least MATERIAL of the output's range. A short delay may differ from record to record (an instrument
changes its measuring range); a long one is a law only where all records share it, and only where speeds or
amplitudes differ: at one speed and amplitude a lag draws the same loop, which data cannot tell from hysteresis.
There only short delays count as laws, and the answer is marked `ambiguous` where a lag would do as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.evidence.memoryless import Law, Spline, Thinned, lagged_laws, own_delays, thinned
from hysteresis_bench.diagnosis.evidence.residual_tests import p_in_words
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.fit.unseen.blocks import blocked

MATERIAL = 0.005
"""Explained RMS, as a share of the output's range, from which branches matter."""

LEVEL = 0.01
"""p of the test whether branches predict better than the best law without memory, below which they do."""

UNCLEAR = 2.0
"""Times the noise that the best law may leave, if it is to say that no hysteresis is needed."""

BLOCKS = 40
"""Blocks a record is cut into; every fifth is left out in turn."""

FOLDS = 5
"""Parts that are left out in turn."""

PLAYS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8)
"""Half-widths, as shares of half the input's range."""

CLOSED = 0.02
"""A record that ends so close to where it began (share of the input's range) is a closed loop."""

UNLIKE = 1.3
"""Ratio of the slow to the fast, or the large to the small half-cycles, from which lag and hysteresis differ."""

RIDGES = (1e-9, 1e-6, 1e-4)
"""Penalties of the regressions that are tried, a sample: what predicts best is taken."""


@dataclass(frozen=True)
class Memory:
    """Is hysteresis needed, and what says so.

    p : that branches predict no better than the best law without memory
    static_rmse, dynamic_rmse, branch_rmse : on samples not fitted, unit of the output
    explained : RMS that branches explain, as a share of the output's range (without each record's drift)
    law : the best law without branches, in words
    delays : delay of each record in that law, unit of time; 0 without a time base
    ambiguous : one speed and amplitude only, and a lag explains the loop as well as branches do; or no law
        explains the data, with branches or without
    """

    needed: bool
    p: float
    static_rmse: float
    dynamic_rmse: float
    branch_rmse: float
    explained: float
    law: str
    delays: tuple[float, ...]
    ambiguous: bool
    words: str


def memory(records: Sequence[View]) -> Memory:
    """Compare laws with and without branches on these records."""
    views = thinned(records)
    y = np.concatenate([view.y for view in views])
    span = max(float(np.ptp(view.y)) for view in views)
    still = tuple(0.0 for _ in views)
    if span == 0.0 or np.ptp(np.concatenate([view.u for view in views])) == 0.0:
        return Memory(False, 1.0, 0.0, 0.0, 0.0, 0.0, "constant", still, False, "a constant needs no hysteresis")
    sizes = [view.y.size for view in views]
    blocks = blocked(sizes, [min(BLOCKS, max(FOLDS, size // 8)) for size in sizes], FOLDS)
    own = _own(views)
    level = y - own @ np.linalg.lstsq(own, y, rcond=None)[0]  # a drift is no part of what hysteresis is measured by
    span = max(float(np.ptp(part)) for part in np.split(level, np.cumsum([view.y.size for view in views])[:-1]))
    spline = Spline([view.u[view.keep] for view in views])
    curve = np.vstack(spline.of(views, [view.u for view in views]))

    order = np.argsort(blocks.fold, kind="stable")
    ends = np.cumsum(np.bincount(blocks.fold, minlength=FOLDS))[:-1]
    sorted_y = y[order]

    @cache
    def errors(law: Law) -> Array:
        """In the order of the folds."""
        return _left_out(np.hstack([own, *law.columns])[order], sorted_y, ends)

    def score(law: Law) -> float:
        left = errors(law)
        return float(left @ left)

    def best(laws: Sequence[Law]) -> tuple[Array, Law]:
        law = min(laws, key=score)
        return errors(law), law

    laws, lagged = [Law("static curve", still, [curve])], []
    if all(view.record.timed for view in records):
        laws.append(own_delays(views, spline))
        lagged = lagged_laws(views, spline, laws[-1], score)
    telling = _telling(views)
    (static, _), (without, law) = best(laws[:1]), best(laws + lagged if telling else laws)
    branches, _ = best(
        [
            Law("branches", still, [*base.columns, *columns])
            for base in (laws[0], law)
            for columns in _branches(views, spline)
        ]
    )
    p = _no_better(branches, without, blocks.block[order])
    rmse = [float(np.sqrt(np.mean(left**2))) for left in (static, without, branches)]
    explained = float(np.sqrt(max(rmse[1] ** 2 - rmse[2] ** 2, 0.0))) / span
    needed = p < LEVEL and explained > MATERIAL
    ambiguous = False
    if needed and lagged and not telling:
        lag = float(np.sqrt(np.mean(best(lagged)[0] ** 2)))
        ambiguous = bool(np.sqrt(max(lag**2 - rmse[2] ** 2, 0.0)) / span < MATERIAL)
    loud = float(np.sqrt(np.mean([view.noise.floor**2 for view in records])))
    unclear = not needed and rmse[1] > max(UNCLEAR * loud, MATERIAL * span)
    words = _words(needed, p, explained, law.name, rmse[1] / span, ambiguous, unclear)
    ambiguous = ambiguous or unclear
    return Memory(needed, p, rmse[0], rmse[1], rmse[2], explained, law.name, law.delays, ambiguous, words)


def _words(needed: bool, p: float, explained: float, law: str, left: float, ambiguous: bool, unclear: bool) -> str:
    without = f"the best law without memory ({law}) leaves {100 * left:.2f} % of the output's range"
    if needed:
        doubt = "; a long lag would draw the same loop: another speed or amplitude would tell" if ambiguous else ""
        return f"{without}; branches explain {100 * explained:.2f} % ({p_in_words(p)}): hysteresis is needed{doubt}"
    if unclear:
        worse = "far more than the noise, and branches predict no better"
        return f"{without}, {worse}: hysteresis cannot be judged while something else is missing"
    if p < LEVEL:
        return f"{without}; branches explain only {100 * explained:.2f} %: no hysteresis is needed"
    return f"{without}; branches predict no better ({p_in_words(p)}): no hysteresis is needed"


def _telling(views: Sequence[Thinned]) -> bool:
    """Do half-cycles differ in duration or height, so that lag and hysteresis draw different loops?"""
    whole = [view.turns for view in views if view.turns.size >= 2]
    if not whole:
        return False
    durations = np.concatenate([np.diff(view.time[view.turns]) for view in views])
    heights = np.concatenate([np.abs(np.diff(view.u[view.turns])) for view in views])
    return any(np.quantile(sizes, 0.9) > UNLIKE * np.quantile(sizes, 0.1) for sizes in (durations, heights))


def _own(views: Sequence[Thinned]) -> Array:
    """Each record's own offset and slope in time."""
    number = np.repeat(np.arange(len(views)), [view.y.size for view in views])
    inside = np.equal.outer(number, np.arange(len(views))).astype(float)
    slope = np.concatenate([np.linspace(-1.0, 1.0, view.y.size) for view in views])
    return np.hstack([inside, inside * slope[:, None]])


def _branches(views: Sequence[Thinned], spline: Spline) -> list[list[Array]]:
    """Several sets of columns that tell branches apart, from few to many."""
    simple, plays = [], []
    for view in views:
        x = spline.scaled(view.u)
        branch = covariates.branch(view.u, view.turns)
        since = x - spline.scaled(covariates.last_extremum(view.u, view.turns))
        simple.append(np.column_stack([branch, branch * x, branch * x**2, since, since * np.abs(since)])[view.keep])
        play = _settled_play if abs(x[-1] - x[0]) < CLOSED * np.ptp(x) else covariates.play
        plays.append(np.column_stack([play(x, radius) for radius in PLAYS])[view.keep])
    few, many = np.vstack(simple), np.vstack(plays)
    return [[few], [many], [few, many], [many, many**2, many**3], [few, many, many**2, many**3]]


def _settled_play(x: Array, radius: float) -> Array:
    """The second of two passes of a closed loop."""
    return covariates.play(np.concatenate([x, x]), radius)[x.size :]


def _left_out(columns: Array, y: Array, ends: Array) -> Array:
    """Errors on every fold, of a fit to the others; with the best of a few whiffs of ridge.

    columns, y : samples one fold after the other;  ends : of all folds but the last
    """
    size = np.sqrt(np.einsum("ij,ij->j", columns, columns) / y.size)
    scaled = columns[:, size > 0] / size[size > 0]
    parts = list(zip(np.split(scaled, ends), np.split(y, ends), strict=True))
    grams = np.array([part.T @ part for part, _ in parts])
    products = np.array([part.T @ values for part, values in parts])
    penalties = np.multiply.outer(RIDGES, y.size * np.eye(grams.shape[1]))
    kept = (grams.sum(axis=0) - grams)[:, None] + penalties
    right = np.broadcast_to((products.sum(axis=0) - products)[:, None, :, None], (*kept.shape[:3], 1))
    found = np.linalg.solve(kept, right)[..., 0]  # (folds, ridges, columns)
    errors = np.concatenate([values[:, None] - part @ own.T for (part, values), own in zip(parts, found, strict=True)])
    best: Array = errors[:, np.argmin(np.einsum("ij,ij->j", errors, errors))]
    return best


def _no_better(ours: Array, theirs: Array, blocks: Array) -> float:
    """One-sided signed-rank p over blocks, which are taken for independent: that our squares are not smaller."""
    from scipy.stats import wilcoxon

    _, block = np.unique(blocks, return_inverse=True)
    gains = np.bincount(block, theirs**2 - ours**2) / np.bincount(block)
    return float(wilcoxon(gains, alternative="greater").pvalue) if np.any(gains) else 1.0

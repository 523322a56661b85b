"""Does the data need hysteresis at all? Laws without branches against the same laws with branches.

Without: a static curve (cubic spline) of the input, which where there is a time base may be delayed or lagged,
plus a spectrum of first-order lags. With: the same, and columns whose value depends on past extrema and not on
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

import numpy as np
from numpy.typing import NDArray

from hysteresis_bench.diagnosis import covariates
from hysteresis_bench.diagnosis.noise import fast_noise
from hysteresis_bench.signals import Record

MATERIAL = 0.005
"""Explained RMS, as a share of the output's range, from which branches matter."""

LEVEL = 0.01
BLOCKS = 40
"""Blocks a record is cut into; every fifth is left out in turn."""

FOLDS = 5
KNOTS = 9
PLAYS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8)
"""Half-widths, as shares of half the input's range."""

LAGS = 6
SHARED_DELAYS = np.geomspace(1e-3, 0.25, 12)
"""Delays and lags tried for all records alike, as shares of their shortest period."""

OWN_DELAY = 0.03
"""A record's own delay is at most this share of its period: an instrument's, not a law."""

CLOSED = 0.02
"""A record that ends so close to where it began (share of the input's range) is a closed loop."""

UNLIKE = 1.3
"""Ratio of the slow to the fast, or the large to the small half-cycles, from which lag and hysteresis differ."""

RIDGES = (1e-9, 1e-6, 1e-4)

MOST = 6000
"""Samples beyond which records are thinned: the question is about shapes, not about digits."""


@dataclass(frozen=True)
class Memory:
    """Is hysteresis needed, and what says so.

    p : that branches predict no better than the best law without memory
    static_rmse, dynamic_rmse, branch_rmse : on samples not fitted, unit of the output
    explained : RMS that branches explain, as a share of the output's range
    law : the best law without branches, in words
    delays : delay of each record in that law, unit of time; 0 without a time base
    ambiguous : one speed and amplitude only, and a lag explains the loop as well as branches do
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


@dataclass(frozen=True, eq=False)
class _View:
    """A record with its history, and which of its samples count."""

    time: NDArray
    u: NDArray
    y: NDArray
    keep: NDArray
    turns: NDArray

    @property
    def period(self) -> float:
        """Mean duration of a cycle."""
        return 2.0 * float(self.time[-1] - self.time[0]) / (self.turns.size + 1)


@dataclass(frozen=True, eq=False)
class _Law:
    name: str
    delays: tuple[float, ...]
    columns: list[NDArray]


def memory(records: Sequence[Record]) -> Memory:
    """Compare laws with and without branches on these records. Raises ValueError where one has no output."""
    views = _views(records)
    y = np.concatenate([view.y for view in views])
    span = max(float(np.ptp(view.y)) for view in views)
    still = tuple(0.0 for _ in views)
    if span == 0.0 or np.ptp(np.concatenate([view.u for view in views])) == 0.0:
        return Memory(False, 1.0, 0.0, 0.0, 0.0, 0.0, "constant", still, False, "a constant needs no hysteresis")
    folds, blocks = _blocks(views)
    own, spline = _own(views), _Spline([view.u[view.keep] for view in views])
    curve = spline.of(views, [view.u for view in views])

    def best(laws: Sequence[_Law]) -> tuple[NDArray, _Law]:
        tried = [(_left_out(np.hstack([own, *law.columns]), y, folds), law) for law in laws]
        return min(tried, key=lambda pair: float(pair[0] @ pair[0]))

    laws, lagged = [_Law("static curve", still, [curve])], []
    if all(record.timed for record in records):
        laws.append(_own_delays(views, spline))
        lagged = _lagged_laws(views, spline)
    telling = _telling(views)
    (static, _), (without, law) = best(laws[:1]), best(laws + lagged if telling else laws)
    branches, _ = best(
        [
            _Law("branches", still, [*base.columns, *columns])
            for base in (laws[0], law)
            for columns in _branches(views, spline)
        ]
    )
    p = _no_better(branches, without, blocks)
    rmse = [float(np.sqrt(np.mean(left**2))) for left in (static, without, branches)]
    explained = float(np.sqrt(max(rmse[1] ** 2 - rmse[2] ** 2, 0.0))) / span
    needed = p < LEVEL and explained > MATERIAL
    ambiguous = False
    if needed and lagged and not telling:
        lag = float(np.sqrt(np.mean(best(lagged)[0] ** 2)))
        ambiguous = bool(np.sqrt(max(lag**2 - rmse[2] ** 2, 0.0)) / span < MATERIAL)
    words = _words(needed, p, explained, law.name, rmse[1] / span, ambiguous)
    return Memory(needed, p, rmse[0], rmse[1], rmse[2], explained, law.name, law.delays, ambiguous, words)


def _words(needed: bool, p: float, explained: float, law: str, left: float, ambiguous: bool) -> str:
    without = f"the best law without memory ({law}) leaves {left:.2%} of the output's range"
    if needed:
        doubt = "; a long lag would draw the same loop: another speed or amplitude would tell" if ambiguous else ""
        return f"{without}; branches explain {explained:.2%} (p = {p:.2g}): hysteresis is needed{doubt}"
    if p < LEVEL:
        return f"{without}; branches explain only {explained:.2%}: no hysteresis is needed"
    return f"{without}; branches predict no better (p = {p:.2g}): no hysteresis is needed"


def _telling(views: Sequence[_View]) -> bool:
    """Do half-cycles differ in duration or height, so that lag and hysteresis draw different loops?"""
    whole = [view.turns for view in views if view.turns.size >= 2]
    if not whole:
        return False
    durations = np.concatenate([np.diff(view.time[view.turns]) for view in views])
    heights = np.concatenate([np.abs(np.diff(view.u[view.turns])) for view in views])
    return any(np.quantile(sizes, 0.9) > UNLIKE * np.quantile(sizes, 0.1) for sizes in (durations, heights))


def _views(records: Sequence[Record]) -> list[_View]:
    thin = max(1, -(-sum(record.measured.size for record in records) // MOST))
    views = []
    for record in records:
        u, keep = record.input, np.arange(record.history, record.time.size, thin)
        resolution = covariates.resolution_of(u, fast_noise(record.time, u)[0])
        turns = covariates.turning_points(u, resolution)
        views.append(_View(record.time, u, record.measured[::thin], keep, turns))
    return views


def _blocks(views: Sequence[_View]) -> tuple[NDArray, NDArray]:
    """Fold and block of every sample."""
    blocks = [np.arange(view.y.size) * min(BLOCKS, max(FOLDS, view.y.size // 8)) // view.y.size for view in views]
    folds = np.concatenate([(part + 2 * number) % FOLDS for number, part in enumerate(blocks)])
    return folds, np.concatenate([part + BLOCKS * number for number, part in enumerate(blocks)])


def _own(views: Sequence[_View]) -> NDArray:
    """Each record's own offset and slope in time."""
    number = np.repeat(np.arange(len(views)), [view.y.size for view in views])
    inside = np.equal.outer(number, np.arange(len(views))).astype(float)
    slope = np.concatenate([np.linspace(-1.0, 1.0, view.y.size) for view in views])
    return np.hstack([inside, inside * slope[:, None]])


class _Spline:
    """Cubic truncated powers of the scaled input, knots at the inputs' quantiles; no constant."""

    def __init__(self, inputs: Sequence[NDArray]) -> None:
        joined = np.concatenate(list(inputs))
        self.middle, self.half = 0.5 * float(joined.max() + joined.min()), 0.5 * float(np.ptp(joined))
        self.knots = np.unique(self.scaled(np.quantile(joined, np.linspace(0.0, 1.0, KNOTS + 2)[1:-1])))

    def scaled(self, values: NDArray) -> NDArray:
        return (values - self.middle) / self.half

    def of(self, views: Sequence[_View], inputs: Sequence[NDArray]) -> NDArray:
        x = self.scaled(np.concatenate([values[view.keep] for view, values in zip(views, inputs, strict=True)]))
        return np.column_stack([x, x**2, x**3, np.maximum(x[:, None] - self.knots, 0.0) ** 3])


def _lagged_laws(views: Sequence[_View], spline: _Spline) -> list[_Law]:
    """Curves of the delayed or lagged input, alike for all records or each with its short delay, plus lags."""
    lags, laws = _lags(views), []
    none = tuple(0.0 for _ in views)
    for share in SHARED_DELAYS * min(view.period for view in views):
        late = [covariates.delayed(view.time, view.u, share) for view in views]
        laws.append(_Law(f"curve of the input {share:.3g} ago", (share,) * len(views), [spline.of(views, late), lags]))
        lagged = [covariates.low_pass(view.time, view.u, share) for view in views]
        laws.append(_Law(f"curve of the input lagged by {share:.3g}", none, [spline.of(views, lagged), lags]))
    own = _own_delays(views, spline)
    return [*laws, _Law(own.name, own.delays, [*own.columns, lags])]


def _own_delays(views: Sequence[_View], spline: _Spline) -> _Law:
    delays = tuple(_own_delay(view) for view in views)
    late = [covariates.delayed(view.time, view.u, delay) for view, delay in zip(views, delays, strict=True)]
    return _Law("curve of the input, each record with a short delay", delays, [spline.of(views, late)])


def _own_delay(view: _View) -> float:
    """The short delay that makes this record's output most nearly a curve of its input."""
    from scipy.optimize import minimize_scalar

    spline, own = _Spline([view.u[view.keep]]), _own([view])

    def left(delay: float) -> float:
        columns = np.hstack([own, spline.of([view], [covariates.delayed(view.time, view.u, delay)])])
        errors = view.y - columns @ np.linalg.lstsq(columns, view.y, rcond=1e-10)[0]
        return float(errors @ errors)

    limit = OWN_DELAY * view.period
    return float(minimize_scalar(left, bounds=(-limit, limit), method="bounded", options={"xatol": 1e-3 * limit}).x)


def _lags(views: Sequence[_View]) -> NDArray:
    """The input through first-order lags, from a few samples to a third of the longest record."""
    shortest = 2.0 * float(np.median(np.concatenate([np.diff(view.time) for view in views])))
    longest = max(float(view.time[-1] - view.time[0]) for view in views) / 3.0
    constants = np.geomspace(shortest, max(longest, 2.0 * shortest), LAGS)
    return np.vstack(
        [np.column_stack([covariates.low_pass(view.time, view.u, c)[view.keep] for c in constants]) for view in views]
    )


def _branches(views: Sequence[_View], spline: _Spline) -> list[list[NDArray]]:
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


def _settled_play(x: NDArray, radius: float) -> NDArray:
    """The second of two passes of a closed loop."""
    return covariates.play(np.concatenate([x, x]), radius)[x.size :]


def _left_out(columns: NDArray, y: NDArray, folds: NDArray) -> NDArray:
    """Errors on every fold, of a fit to the others; with the best of a few whiffs of ridge."""
    size = np.sqrt(np.mean(columns**2, axis=0))
    scaled = columns[:, size > 0] / size[size > 0]
    whole, right = scaled.T @ scaled, scaled.T @ y
    parts = [(scaled[folds == fold], y[folds == fold]) for fold in range(FOLDS)]
    kept = [(whole - part.T @ part, right - part.T @ values) for part, values in parts]
    best = np.full(y.size, np.inf)
    for ridge in RIDGES:
        penalty = ridge * y.size * np.eye(len(whole))
        errors = np.empty(y.size)
        for fold, ((gram, product), (part, values)) in enumerate(zip(kept, parts, strict=True)):
            errors[folds == fold] = values - part @ np.linalg.solve(gram + penalty, product)
        best = min(best, errors, key=lambda left: float(left @ left))
    return best


def _no_better(ours: NDArray, theirs: NDArray, blocks: NDArray) -> float:
    """One-sided signed-rank p over blocks, which are taken for independent: that our squares are not smaller."""
    from scipy.stats import wilcoxon

    _, block = np.unique(blocks, return_inverse=True)
    gains = np.bincount(block, theirs**2 - ours**2) / np.bincount(block)
    return float(wilcoxon(gains, alternative="greater").pvalue) if np.any(gains) else 1.0

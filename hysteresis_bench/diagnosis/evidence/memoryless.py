"""Laws without memory of past extrema: static curves and linear dynamics of the input, as columns of a regression.

A curve is a cubic spline. Where there is a time base it may be a curve of the delayed or lagged input, a lagged
curve, or a curve and a resonance, plus a spectrum of first-order lags. All are linear in what is fitted but for
one number each.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.evidence.view import View

INTERVALS = 14
"""Of the spline that a curve is, over the range of the input."""

LAGS = 6
"""Time constants of the spectrum of first-order lags."""

SHARED_DELAYS = np.geomspace(2e-3, 0.25, 9)
"""Delays and lags tried for all records alike, as shares of their shortest period."""

DAMPINGS = np.array([0.03, 0.1, 0.3])
"""Ratios of the resonances that are tried."""

OWN_DELAY = 0.015
"""A record's own delay is at most this share of its period: an instrument's, not a law."""

MOST_SAMPLES = 3000
"""Samples beyond which records are thinned: the question is about shapes, not about digits."""


@dataclass(frozen=True, eq=False)
class Thinned:
    """A record with its history, and which of its samples count.

    time, u : (samples,) of the whole record;  keep : those that count;  y : the output there
    turns : samples at which the input turns;  unit : of the time
    """

    time: Array
    u: Array
    y: Array
    keep: Array
    turns: Array
    unit: str

    @property
    def period(self) -> float:
        """Typical duration of a cycle."""
        if self.turns.size >= 2:
            return 2.0 * float(np.median(np.diff(self.time[self.turns])))
        return 2.0 * float(self.time[-1] - self.time[0]) / (self.turns.size + 1)


@dataclass(frozen=True, eq=False)
class Law:
    """name : in words; delays : of each record; columns : (counted samples of all records, any) each."""

    name: str
    delays: tuple[float, ...]
    columns: list[Array]


Score = Callable[[Law], float]


def thinned(views: Sequence[View]) -> list[Thinned]:
    """The records with MOST_SAMPLES counted samples at most."""
    every = max(1, -(-sum(view.y.size for view in views) // MOST_SAMPLES))
    return [
        Thinned(
            view.record.time,
            view.record.input,
            view.y[::every],
            np.arange(view.record.history, view.record.time.size, every),
            view.turns,
            view.record.units.get("time", "s"),
        )
        for view in views
    ]


class Spline:
    """Cubic B-splines of the scaled input on even intervals, and the cubic that they share; no constant."""

    def __init__(self, inputs: Sequence[Array]) -> None:
        joined = np.concatenate(list(inputs))
        self.middle, self.half = 0.5 * float(joined.max() + joined.min()), 0.5 * float(np.ptp(joined)) or 1.0
        self.knots = np.concatenate([[-1.0] * 3, np.linspace(-1.0, 1.0, INTERVALS + 1), [1.0] * 3])

    def scaled(self, values: Array) -> Array:
        return (values - self.middle) / self.half

    def of(self, views: Sequence[Thinned], inputs: Sequence[Array]) -> list[Array]:
        """Columns of each record's counted samples; inputs : (samples,) a record."""
        from hysteresis_bench.kernels.cubic_spline import cubic_spline

        kept = (np.clip(self.scaled(part[view.keep]), -1.0, 1.0) for view, part in zip(views, inputs, strict=True))
        return [cubic_spline(x, self.knots) for x in kept]


def delayed_curve(views: Sequence[Thinned], spline: Spline, delays: Sequence[float]) -> Array:
    """The spline of the input, each record's by its delay earlier; all records in one."""
    late = [covariates.delayed(view.time, view.u, delay) for view, delay in zip(views, delays, strict=True)]
    return np.vstack(spline.of(views, late))


def lagged_laws(views: Sequence[Thinned], spline: Spline, own: Law, score: Score) -> list[Law]:
    """The best curve of the delayed input, of the lagged input, lagged curve, and curve with a resonance, alike for
    all records; and `own`, the curve of the input with each record's short delay. Each plus a spectrum of lags."""
    lags, still = lags_of(views), tuple(0.0 for _ in views)
    curves, unit = spline.of(views, [view.u for view in views]), views[0].unit

    def late(value: float) -> Law:
        delays = (value,) * len(views)
        return Law(f"curve of the input {value:.3g} {unit} ago", delays, [delayed_curve(views, spline, delays), lags])

    def wiener(value: float) -> Law:
        lagged = spline.of(views, [covariates.low_pass(view.time, view.u, value) for view in views])
        return Law(f"curve of the input behind a lag of {value:.3g} {unit}", still, [np.vstack(lagged), lags])

    def hammerstein(value: float) -> Law:
        lagged = [
            covariates.low_pass(view.time[view.keep], part, value) for view, part in zip(views, curves, strict=True)
        ]
        return Law(f"lag of {value:.3g} {unit} behind a curve of the input", still, [np.vstack(lagged), lags])

    def resonance(value: float) -> Law:
        modes = np.vstack([_modes(view, 1.0 / value) for view in views])
        return Law(f"curve of the input and a resonance at {1 / value:.3g} rad/{unit}", still, [static, modes, lags])

    static = np.vstack(curves)
    grid = SHARED_DELAYS * min(view.period for view in views)
    even = all(np.ptp(np.diff(view.time)) < 1e-6 * (view.time[1] - view.time[0]) for view in views)
    families = (late, wiener, hammerstein, resonance) if even else (late, wiener, hammerstein)
    return [
        *(_refined(family, grid, score) for family in families),
        Law(f"{own.name}, and lags", own.delays, [*own.columns, lags]),
    ]


def _refined(family: Callable[[float], Law], grid: Array, score: Score) -> Law:
    """The best of a family of one parameter: on the grid, then between its neighbours there."""
    from scipy.optimize import minimize_scalar

    best = int(np.argmin([score(family(value)) for value in grid]))
    bounds = (np.log(grid[max(best - 1, 0)]), np.log(grid[min(best + 1, grid.size - 1)]))
    found = minimize_scalar(lambda x: score(family(np.exp(x))), bounds=bounds, method="bounded", options={"maxiter": 8})
    return min((family(float(np.exp(found.x))), family(float(grid[best]))), key=score)


def _modes(view: Thinned, frequency: float) -> Array:
    """Position and velocity of second-order systems of this natural frequency (rad per unit of time) and several
    dampings, exact for a piecewise linear, evenly sampled input, at rest at first."""
    from hysteresis_bench.kernels.second_order import modes

    found: Array = modes(float(view.time[1] - view.time[0]), view.u, frequency, DAMPINGS)[view.keep]
    return found


def own_delays(views: Sequence[Thinned], spline: Spline) -> Law:
    """The curve of the input with each record's own short delay."""
    delays = tuple(_own_delay(view) for view in views)
    columns = [delayed_curve(views, spline, delays)]
    return Law("curve of the input, each record with a short delay", delays, columns)


def _own_delay(view: Thinned) -> float:
    """The short delay that makes this record's output most nearly a curve of its input."""
    from scipy.optimize import minimize_scalar

    spline = Spline([view.u[view.keep]])
    slope = np.linspace(-1.0, 1.0, view.y.size)

    def left(delay: float) -> float:
        columns = delayed_curve([view], spline, [delay])[:, 2:]  # the splines span the powers, and the constant
        columns[:, 0] = slope
        gram = columns.T @ columns
        errors = view.y - columns @ np.linalg.lstsq(gram, columns.T @ view.y, rcond=1e-13)[0]
        return float(errors @ errors)

    limit = OWN_DELAY * view.period
    return float(minimize_scalar(left, bounds=(-limit, limit), method="bounded", options={"xatol": 1e-3 * limit}).x)


def lags_of(views: Sequence[Thinned]) -> Array:
    """The input through first-order lags, from a few samples to a third of the longest record."""
    shortest = 2.0 * float(np.median(np.concatenate([np.diff(view.time) for view in views])))
    longest = max(float(view.time[-1] - view.time[0]) for view in views) / 3.0
    constants = np.geomspace(shortest, max(longest, 2.0 * shortest), LAGS)
    return np.vstack(
        [np.column_stack([covariates.low_pass(view.time, view.u, c)[view.keep] for c in constants]) for view in views]
    )

"""Eddy currents inside a hysteresis law: what acts is the input less a drag on the rate of the output.

[1] G. Bertotti, Hysteresis in Magnetism, Academic Press (1998), ch. 12: classical eddy currents in a lamination
    oppose the applied field in proportion to the rate of the induction.
[2] D. C. Jiles, Modelling the effects of eddy current losses on frequency dependent hysteresis in electrically
    conducting media, IEEE Trans. Magnetics 30 (1994) 4326.
[3] W. Liniger, R. A. Willoughby, Efficient integration methods for stiff systems of ordinary differential
    equations, SIAM J. Numer. Anal. 7 (1970) 47: exponential fitting of the theta method.
[4] T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function
    without using derivatives, Advances in Engineering Software 28 (1997) 145.

With u the input, z what acts, y = F[z] the hysteresis law and e the coefficient,

    z = u - e dy/dt.

Over one sample of duration h the mean of both sides is taken with a weight theta on its end:

    theta (z_i - u_i) + (1 - theta) (z_j - u_j) + (e / h) (F(z_i) - y_j) = 0,    j = i - 1.

theta is such that a law of constant slope, which makes this a first-order lag of e times the slope, is exact for
an input that is linear between its samples [3]. It goes from 1/2, second order, where that lag is longer than h, to
1 where it is shorter, so that nothing rings. The left side grows with z_i along the one branch of the law that leaves
z_j: one root, always bracketed, found without a derivative as in [4], from the slope of the step before on.

Particles are solved for in groups of `lanes`; groups that are done wait for the others.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import exponential
from hysteresis_bench.kernels.lanes import LANES, OPEN, OUT, SOLVER, TRIAL, Y, Z

TOLERANCE = 1e-10
"""The equation is solved to this share of its value before the step, or the trial to this share of its bracket."""
USUAL = 8
"""Trials of one step by interpolation alone; then every other one halves the bracket."""
MOST = 100
"""Trials of one step; half a dozen are usual."""

# Rows of a group's work: inputs, the output's slope before the step; the equation; the bracket, the distance of the
# trial from Z, the width that ends the search.
COEFFICIENT, U, NEW, SLOPE, RATE, THETA, BEFORE, ALONG = ((SOLVER + row) * LANES for row in range(8))
LOW, BELOW, HIGH, ABOVE, WAY, NARROW = ((SOLVER + row) * LANES for row in range(8, 14))


@njit(error_model="numpy", inline="always")
def end_weight(x):  # type: ignore[no-untyped-def]
    """theta = 1 / (1 - exp(-x)) - 1 / x, from 1/2 at x = 0 to 1 at infinity; x : step over time constant."""
    z = x * x
    series = 1 / 1209600 - z * (1 / 47900160 - z * (691 / 1307674368000 - z * (1 / 74724249600)))
    series = x * (1 / 12 - z * (1 / 720 - z * (1 / 30240 - z * series)))
    x = min(x, 1e300)
    faded = 1.0 - exponential(-x)
    return 0.5 + series if x < 0.5 else (x - faded) / (x * faded)


@njit(cache=True, error_model="numpy")
def _begun(s: Array) -> int:
    """The equation from the law's output at the new input; next, the end of the bracket is tried
    -> for how many lanes that is somewhere else.

    The answer stays between Z and the inputs.
    """
    elsewhere = 0
    for j in range(LANES):
        u, new, z, rate = s[U + j], s[NEW + j], s[Z + j], s[RATE + j]
        lead, drag = new - z, rate * (s[OUT + j] - s[Y + j])
        weight = end_weight(lead / drag)
        theta = weight if lead * drag > 0.0 else 1.0
        behind = z - u
        undragged = new - (1.0 - theta) / theta * behind
        undragged = min(max(undragged, min(u, new)), max(u, new))
        s[THETA + j] = theta
        s[BEFORE + j] = -abs(behind - theta * (new - u))
        s[ALONG + j] = 1.0 if undragged > z else -1.0
        s[WAY + j] = abs(undragged - z)
        s[TRIAL + j] = undragged
        elsewhere += 1 if undragged != new else 0
    return elsewhere


@njit(inline="always", error_model="numpy")
def _value(s, j):  # type: ignore[no-untyped-def]
    """The equation's left side at the trial. Ours: where the law moves against its input, there is no drag."""
    return s[BEFORE + j] + s[THETA + j] * s[WAY + j] + s[RATE + j] * max(s[ALONG + j] * (s[OUT + j] - s[Y + j]), 0.0)


@njit(cache=True, error_model="numpy")
def _bracketed(s: Array) -> int:
    """The bracket from Z to the trial; next, the last step's slope is tried, or the secant -> number of open lanes."""
    left = 0
    for j in range(LANES):
        before, high, along = s[BEFORE + j], s[WAY + j], s[ALONG + j]
        above = _value(s, j)
        open_ = above > TOLERANCE * -before
        way = -before / (s[THETA + j] + s[RATE + j] * max(along * s[SLOPE + j], 0.0))
        way = way if way < high else -before * high / (above - before)
        s[LOW + j], s[BELOW + j], s[HIGH + j], s[ABOVE + j] = 0.0, before, high, above
        s[NARROW + j] = TOLERANCE * high
        s[WAY + j] = way
        s[TRIAL + j] = s[Z + j] + along * way if open_ else s[TRIAL + j]
        s[OPEN + j] = 1.0 if open_ else 0.0
        left += 1 if open_ else 0
    return left


@njit(cache=True, error_model="numpy")
def _narrowed(s: Array, halved: bool) -> int:
    """The trial replaces the end on its side of the root, which is dropped; next, the inverse parabola through the
    three is tried [4], or the middle where it leads out of the bracket -> number of open lanes."""
    left = 0
    for j in range(LANES):
        low, below, high, above, way = s[LOW + j], s[BELOW + j], s[HIGH + j], s[ABOVE + j], s[WAY + j]
        value = _value(s, j)
        open_ = (s[OPEN + j] > 0.0) & (abs(value) > TOLERANCE * -s[BEFORE + j]) & (high - low > s[NARROW + j])
        short = value < 0.0
        dropped, lost = low if short else high, below if short else above
        other, opposite = high if short else low, above if short else below
        s[LOW + j], s[BELOW + j] = way if short else low, value if short else below
        s[HIGH + j], s[ABOVE + j] = high if short else way, above if short else value
        rise, fall = opposite - value, lost - value
        to_other, to_dropped = other - way, dropped - way
        share = value * (to_dropped * opposite * rise - lost * to_other * fall)
        share = share / ((lost - opposite) * rise * fall * to_other)
        share = share if (share > 0.0) & (share < 1.0) & (not halved) else 0.5
        way += share * to_other
        s[WAY + j] = way
        s[TRIAL + j] = s[Z + j] + s[ALONG + j] * way if open_ else s[TRIAL + j]
        s[OPEN + j] = 1.0 if open_ else 0.0
        left += 1 if open_ else 0
    return left


@njit(cache=True, error_model="numpy")
def _driven(s: Array, u: Array, column: int, duration: float) -> None:
    """The next input, which is tried first; u has one for all particles, or this group's from `column` on."""
    shared = u.size == 1
    for j in range(LANES):
        new = u[0] if shared else u[min(column + j, u.size - 1)]
        s[U + j] = s[NEW + j]
        s[NEW + j] = new
        s[TRIAL + j] = new
        s[OPEN + j] = 1.0
        s[RATE + j] = s[COEFFICIENT + j] / duration


@njit(cache=True, error_model="numpy")
def _moved(s: Array) -> None:
    """The trial is where the step ends; its slope has the sign of the step."""
    for j in range(LANES):
        lead, rise = s[TRIAL + j] - s[Z + j], s[OUT + j] - s[Y + j]
        s[SLOPE + j] = rise / abs(lead) if lead != 0.0 else 0.0
        s[Z + j] = s[TRIAL + j]
        s[Y + j] = s[OUT + j]


# Inlined: a kernel that passed its law to a function of its own could not be cached. Every loop over the groups does
# one short thing, so that the processor goes on to the next group while it waits for results of this one.
@njit(error_model="numpy", inline="always")
def simulated(
    law: Callable[[Any, Array], None],
    keep: Callable[[Any, Array], None],
    of: Any,
    work: Array,
    time: Array,
    u: Array,
    first: int,
    y: Array,
) -> None:
    """All samples of the particles from `first` on that `work` has room for, into their columns of y.

    law(of, s), keep(of, s) : as in `lanes`;  of : whatever else the law wants
    work : float64[groups, rows LANES]; NEW is the first input, Z and Y the state there
    """
    groups = work.shape[0]
    left = np.zeros(groups, dtype=np.int64)
    for i in range(1, time.size):
        for g in range(groups):
            _driven(work[g], u[i], first + g * LANES, time[i] - time[i - 1])
        for g in range(groups):
            law(of, work[g])
        for g in range(groups):
            left[g] = _begun(work[g])
        for g in range(groups):
            if left[g] > 0:
                law(of, work[g])
        for g in range(groups):
            left[g] = _bracketed(work[g])
        trial = 0
        while left.any() and trial < MOST:
            for g in range(groups):
                if left[g] > 0:
                    law(of, work[g])
            for g in range(groups):
                if left[g] > 0:
                    left[g] = _narrowed(work[g], trial >= USUAL and trial % 2 == 0)
            trial += 1
        for g in range(groups):
            keep(of, work[g])
            _moved(work[g])
        for g in range(groups):
            start = first + g * LANES
            for j in range(min(LANES, y.shape[1] - start)):
                y[i, start + j] = work[g, Y + j]

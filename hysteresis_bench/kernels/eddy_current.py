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
z_j: one root, always bracketed, found without a derivative as in [4], from the slope that the last two steps lead to.

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
STEADY = 0.5
"""From step to step the slope is taken to change by at most this share."""

# Rows of a group's work: the input, the output's slopes over the two steps before; the equation; the bracket, the
# distance of the trial from Z, the width that ends the search.
COEFFICIENT, NEW, SLOPE, SLOPE_BEFORE, RATE, THETA, BEFORE, ALONG = ((SOLVER + row) * LANES for row in range(8))
LOW, BELOW, HIGH, ABOVE, WAY, NARROW = ((SOLVER + row) * LANES for row in range(8, 14))


@njit(error_model="numpy", forceinline=True)
def end_weight(x):  # type: ignore[no-untyped-def]
    """theta = 1 / (1 - exp(-x)) - 1 / x, from 1/2 at x = 0 to 1 at infinity; x : step over time constant."""
    z = x * x
    series = 1 / 1209600 - z * (1 / 47900160 - z * (691 / 1307674368000 - z * (1 / 74724249600)))
    series = x * (1 / 12 - z * (1 / 720 - z * (1 / 30240 - z * series)))
    x = min(x, 1e300)
    faded = 1.0 - exponential(-x)
    return 0.5 + series if x < 0.5 else (x - faded) / (x * faded)


@njit(cache=True, error_model="numpy")
def _driven(s: Array, u: Array, first: int, left: Array) -> None:
    """The next input is tried first; u has one for all particles, or one each."""
    shared, last = u.size == 1, u.size - 1
    for g in range(left.size):
        left[g] = LANES
        for j in range(min(LANES, s.shape[1])):
            s[g, TRIAL + j] = u[0] if shared else u[min(first + g * LANES + j, last)]
            s[g, OPEN + j] = 1.0


@njit(cache=True, error_model="numpy")
def _begun(s: Array, duration: float, left: Array) -> None:
    """The equation from the law's output at the new input; next, the end of the bracket is tried where that is
    somewhere else.

    The answer stays between Z and the inputs.
    """
    for g in range(left.size):
        elsewhere = 0
        for j in range(LANES):
            u, new, z, rate = s[g, NEW + j], s[g, TRIAL + j], s[g, Z + j], s[g, COEFFICIENT + j] / duration
            lead, drag = new - z, rate * (s[g, OUT + j] - s[g, Y + j])
            weight = end_weight(lead / drag)
            theta = weight if lead * drag > 0.0 else 1.0
            behind = z - u
            undragged = new - (1.0 - theta) / theta * behind
            undragged = min(max(undragged, min(u, new)), max(u, new))
            s[g, NEW + j] = new
            s[g, RATE + j] = rate
            s[g, THETA + j] = theta
            s[g, BEFORE + j] = -abs(behind - theta * (new - u))
            s[g, ALONG + j] = 1.0 if undragged > z else -1.0
            s[g, WAY + j] = abs(undragged - z)
            s[g, TRIAL + j] = undragged
            elsewhere += 1 if undragged != new else 0
        left[g] = elsewhere


@njit(forceinline=True, error_model="numpy")
def _value(s, g, j):  # type: ignore[no-untyped-def]
    """The equation's left side at the trial. Ours: where the law moves against its input, there is no drag."""
    rise = s[g, ALONG + j] * (s[g, OUT + j] - s[g, Y + j])
    return s[g, BEFORE + j] + s[g, THETA + j] * s[g, WAY + j] + s[g, RATE + j] * max(rise, 0.0)


@njit(cache=True, error_model="numpy")
def _bracketed(s: Array, left: Array) -> int:
    """The bracket from Z to the trial; next, the slope is tried that the last two steps lead to, or the secant
    -> number of open lanes."""
    total = 0
    for g in range(left.size):
        still = 0
        for j in range(LANES):
            before, high, along = s[g, BEFORE + j], s[g, WAY + j], s[g, ALONG + j]
            above = _value(s, g, j)
            open_ = above > TOLERANCE * -before
            last, earlier = along * s[g, SLOPE + j], along * s[g, SLOPE_BEFORE + j]
            slope = last + min(max(last - earlier, -STEADY * last), STEADY * last) if earlier > 0.0 else last
            way = -before / (s[g, THETA + j] + s[g, RATE + j] * max(slope, 0.0))
            way = way if way < high else -before * high / (above - before)
            s[g, LOW + j], s[g, BELOW + j], s[g, HIGH + j], s[g, ABOVE + j] = 0.0, before, high, above
            s[g, NARROW + j] = TOLERANCE * high
            s[g, WAY + j] = way
            s[g, TRIAL + j] = s[g, Z + j] + along * way if open_ else s[g, TRIAL + j]
            s[g, OPEN + j] = 1.0 if open_ else 0.0
            still += 1 if open_ else 0
        left[g] = still
        total += still
    return total


@njit(cache=True, error_model="numpy")
def _narrowed(s: Array, halved: bool, left: Array) -> int:
    """The trial replaces the end on its side of the root, which is dropped; next, the inverse parabola through the
    three is tried [4], or the middle where it leads out of the bracket -> number of open lanes."""
    total = 0
    for g in range(left.size):
        if left[g] == 0:
            continue
        still = 0
        for j in range(LANES):
            low, below, high, above = s[g, LOW + j], s[g, BELOW + j], s[g, HIGH + j], s[g, ABOVE + j]
            way, value = s[g, WAY + j], _value(s, g, j)
            wide = (abs(value) > TOLERANCE * -s[g, BEFORE + j]) & (high - low > s[g, NARROW + j])
            open_ = (s[g, OPEN + j] > 0.0) & wide
            under = value < 0.0
            dropped, lost = low if under else high, below if under else above
            other, opposite = high if under else low, above if under else below
            s[g, LOW + j], s[g, BELOW + j] = way if under else low, value if under else below
            s[g, HIGH + j], s[g, ABOVE + j] = high if under else way, above if under else value
            rise, fall = opposite - value, lost - value
            to_other, to_dropped = other - way, dropped - way
            share = value * (to_dropped * opposite * rise - lost * to_other * fall)
            share = share / ((lost - opposite) * rise * fall * to_other)
            share = share if (share > 0.0) & (share < 1.0) & (not halved) else 0.5
            way += share * to_other
            s[g, WAY + j] = way
            s[g, TRIAL + j] = s[g, Z + j] + s[g, ALONG + j] * way if open_ else s[g, TRIAL + j]
            s[g, OPEN + j] = 1.0 if open_ else 0.0
            still += 1 if open_ else 0
        left[g] = still
        total += still
    return total


@njit(cache=True, error_model="numpy")
def _moved(s: Array, left: Array) -> None:
    """The trial is where the step ends; its slope has the sign of the step."""
    for g in range(left.size):
        for j in range(min(LANES, s.shape[1])):
            lead, rise, last = s[g, TRIAL + j] - s[g, Z + j], s[g, OUT + j] - s[g, Y + j], s[g, SLOPE + j]
            s[g, SLOPE_BEFORE + j] = last
            s[g, SLOPE + j] = rise / abs(lead) if lead != 0.0 else 0.0
            s[g, Z + j] = s[g, TRIAL + j]
            s[g, Y + j] = s[g, OUT + j]


# Inlined: a kernel that passed its law to a function of its own could not be cached. Every loop over the groups does
# one short thing, so that the processor goes on to the next group while it waits for results of this one.
@njit(error_model="numpy", inline="always")
def simulated(
    law: Callable[[Any, Array, Array], None],
    keep: Callable[[Any, Array], None],
    of: Any,
    work: Array,
    time: Array,
    u: Array,
    first: int,
    y: Array,
) -> None:
    """All samples of the particles from `first` on that `work` has room for, into their columns of y.

    law(of, work, left), keep(of, work) : as in `lanes`, for the groups g with left[g] > 0, and for all
    of : whatever else the law wants
    work : float64[groups, rows LANES]; NEW is the first input, Z and Y the state there
    """
    left = np.zeros(work.shape[0], dtype=np.int64)
    for i in range(1, time.size):
        _driven(work, u[i], first, left)
        law(of, work, left)
        _begun(work, time[i] - time[i - 1], left)
        law(of, work, left)
        total = _bracketed(work, left)
        trial = 0
        while total > 0 and trial < MOST:
            law(of, work, left)
            total = _narrowed(work, trial >= USUAL and trial % 2 == 0, left)
            trial += 1
        keep(of, work)
        _moved(work, left)
        for p in range(first, min(first + work.shape[0] * LANES, y.shape[1])):
            y[i, p] = work[(p - first) // LANES, Y + (p - first) % LANES]

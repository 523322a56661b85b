"""Bouc-Wen hysteresis of a group of `lanes`, tried for the input that acts: exact, as `bouc_wen_step` is."""

from __future__ import annotations

from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import SERIES_LIMIT, series
from hysteresis_bench.kernels.bouc_wen_step import HUGE, grown, relaxed
from hysteresis_bench.kernels.elementary import exponential
from hysteresis_bench.kernels.lanes import LANES, LAW, OPEN, OUT, TRIAL, Z

# Rows of the law: parameters and state as in `bouc_wen_step`; the last trial's h, and which lanes want the exact step.
DRIVE, MIRROR, ALONG, AGAINST, BOUND, SLOPE, H, FOUND, SPECIAL = ((LAW + row) * LANES for row in range(9))
ROWS = LAW + 9


@njit(cache=True, error_model="numpy")
def prepared(s: Array, j: int, alpha: float, beta: float, gamma: float, d: float, bound: float) -> None:
    """A lane's parameters, h = 0; bound : of h, in units of |alpha d|."""
    loop = alpha * d
    mirror = 1.0 if loop >= 0.0 else -1.0
    s[DRIVE + j] = abs(loop)
    s[MIRROR + j] = mirror
    s[ALONG + j] = beta + mirror * gamma
    s[AGAINST + j] = beta - mirror * gamma
    s[BOUND + j] = abs(loop) * bound
    s[SLOPE + j] = d


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _increment(s, j):  # type: ignore[no-untyped-def]
    """Width, sign of g, g before and its rate."""
    step = s[TRIAL + j] - s[Z + j]
    sign = s[MIRROR + j] if step >= 0.0 else -s[MIRROR + j]
    g = sign * s[H + j]
    along, against = s[ALONG + j], s[AGAINST + j]
    return abs(step), sign, g, against if g < 0.0 else along


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _noted(s, j, sign, g, free, wanted):  # type: ignore[no-untyped-def]
    """What a trial found, in the lanes where it is wanted."""
    found, out, before = s[FOUND + j], s[OUT + j], s[SPECIAL + j]
    special = 1.0 if ((g < 0.0) & (free > 0.0)) | (abs(free) > s[BOUND + j]) else 0.0
    s[FOUND + j] = sign * free if wanted else found
    s[OUT + j] = s[SLOPE + j] * s[TRIAL + j] - sign * free if wanted else out
    s[SPECIAL + j] = special if wanted else before


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _in_series(s: Array) -> int:
    """h, v where the acting input has moved on to the trial, for n = 1 -> how many steps are long for the series."""
    long = 0
    for j in range(LANES):
        width, sign, g, rate = _increment(s, j)
        free = relaxed(g, s[DRIVE + j], rate, width * series(rate * width))
        open_ = s[OPEN + j] > 0.0
        _noted(s, j, sign, g, free, open_)
        long += 1 if open_ & (abs(rate * width) > SERIES_LIMIT) else 0
    return long


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _in_long_steps(s: Array) -> None:
    """The same by the exponential itself; leaves the other lanes alone, which cannot depend on what these want."""
    for j in range(LANES):
        width, sign, g, rate = _increment(s, j)
        free = relaxed(g, s[DRIVE + j], rate, min((1.0 - exponential(-rate * width)) / rate, HUGE))
        _noted(s, j, sign, g, free, (s[OPEN + j] > 0.0) & (abs(rate * width) > SERIES_LIMIT))


@njit(cache=True, error_model="numpy")
def _count(s: Array) -> int:
    special = 0
    for j in range(min(LANES, s.size)):
        special += 1 if (s[OPEN + j] > 0.0) & (s[SPECIAL + j] > 0.0) else 0
    return special


@njit(cache=True, error_model="numpy")
def tried(n: float, s: Array) -> None:
    """v where the acting input has moved on to the trial."""
    if n == 1.0:
        if _in_series(s) > 0:
            _in_long_steps(s)
        if _count(s) == 0:
            return
    else:
        s[SPECIAL : SPECIAL + LANES] = 1.0
    for j in range(LANES):
        if s[OPEN + j] > 0.0 and s[SPECIAL + j] > 0.0:
            width, sign, g, _ = _increment(s, j)
            s[FOUND + j] = sign * grown(g, s[DRIVE + j], s[ALONG + j], s[AGAINST + j], n, width, s[BOUND + j])
            s[OUT + j] = s[SLOPE + j] * s[TRIAL + j] - s[FOUND + j]


@njit(cache=True, error_model="numpy")
def kept(n: float, s: Array) -> None:
    """What the last trial found is the state."""
    for j in range(LANES):
        s[H + j] = s[FOUND + j]

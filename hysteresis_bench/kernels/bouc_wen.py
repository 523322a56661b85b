"""Bouc-Wen hysteresis of a swarm, integrated over increments of the input: rate-independent to rounding.

`bouc_wen_step` has the law and its step for one particle. Its exponentials and branches keep a loop over a swarm
from being vectorised, so `bouc_wen` makes the same step by a series of the exponential, side by side for all
particles, and the step of `bouc_wen_step` only for those whose h crosses 0 or runs away: 18 times as fast.

[1] The PEA paper: a particle swarm genetic hybrid to identify a Hammerstein model, equation (1).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen_step import HUGE, RUNAWAY, grown, regrown, relaxed

SERIES_LIMIT = 0.25
"""Largest |rate w| for the series of (1 - exp(-x)) / x below; its first neglected term is 2.4e-14 there."""

APART = 1e-9
"""Ratio of beta to |gamma| from which no rounding takes h from its bound to where it runs away."""

LANES = 64
"""Particles that are integrated side by side."""

FULL = 8
"""Particles are integrated in multiples of this many, those that pad them at rest: a loop over what is left of a
vector takes longer than one over all of it, but for FEW particles."""
FEW = 3

# Rows of one work array: constant offsets tell the compiler that they do not overlap, unsigned ones that no index is
# negative, which would keep loops from being vectorised.
H, OLD, STEP, WEAKENED, DRIVE, RISING, FALLING, LOW, HIGH, BETA, GAMMA, BOUND, SLOPE, INPUT = (
    np.uint64(row * LANES) for row in range(14)
)
ROWS = 14


@njit(cache=True, error_model="numpy", fastmath=True)
def paths(u: Array) -> Array:
    """Length of the path of every column of u, float64[samples, columns]."""
    samples, columns = u.shape
    lengths = np.zeros(columns)
    if columns == 1:  # a scalar, so that the loop over the samples is vectorised instead
        shared, total = u[:, 0].copy(), 0.0
        for i in range(1, samples):
            total += abs(shared[i] - shared[i - 1])
        lengths[0] = total
        return lengths
    for i in range(1, samples):
        for j in range(columns):
            lengths[j] += abs(u[i, j] - u[i - 1, j])
    return lengths


@njit(cache=True, error_model="numpy")
def bounded(alpha: Array, beta: Array, gamma: Array, d: Array) -> bool:
    """Does h have a bound for all particles? Then it never comes near RUNAWAY.

    With beta = 0 the bound is where h begins to run away, and rounding decides.
    """
    for k in range(d.size):
        along = beta[k] + gamma[k] if alpha[k] * d[k] >= 0.0 else beta[k] - gamma[k]
        if not (beta[k] > APART * abs(gamma[k]) and along >= 0.0):
            return False
    return True


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def series(x):  # type: ignore[no-untyped-def]
    """(1 - exp(-x)) / x for |x| <= SERIES_LIMIT, in an order that a processor can overlap."""
    x2 = x * x
    x4 = x2 * x2
    first = (1.0 - x * (1.0 / 2.0)) + x2 * (1.0 / 6.0 - x * (1.0 / 24.0))
    middle = (1.0 / 120.0 - x * (1.0 / 720.0)) + x2 * (1.0 / 5040.0 - x * (1.0 / 40320.0))
    last = 1.0 / 362880.0 - x * (1.0 / 3628800.0)
    return (first + x4 * middle) + (x4 * x4) * last


@njit(cache=True, error_model="numpy")
def prepared(work: Array, j: np.uint64, p: tuple[Array, ...], k: int, path: tuple[float, float, float]) -> float:
    """Lane j is particle k at rest; p : alpha, beta, gamma, d;  path : its first input, length, n -> fastest rate."""
    alpha, beta, gamma, d = p
    work[DRIVE + j] = alpha[k] * d[k]
    work[BETA + j], work[GAMMA + j], work[SLOPE + j] = beta[k], gamma[k], d[k]
    work[INPUT + j] = path[0]
    work[BOUND + j] = RUNAWAY * abs(work[DRIVE + j]) * path[1]
    _sided(work, j, path[2])
    return max(abs(beta[k] + gamma[k]), abs(beta[k] - gamma[k]))


@njit(cache=True, error_model="numpy")
def _sided(work: Array, j: np.uint64, n: float) -> None:
    """What the sign of a lane's h decides: its rate where the input rises or falls, and up to where that holds."""
    h, beta, gamma, bound = work[H + j], work[BETA + j], work[GAMMA + j], work[BOUND + j]
    mirror = 1.0 if work[DRIVE + j] >= 0.0 else -1.0
    rising = math.copysign(1.0, h) if h != 0.0 else mirror  # the sign of h
    falling = rising if h != 0.0 else -mirror
    even = n == 2.0  # of a power that is written without |h|
    work[RISING + j] = (beta + rising * gamma) * (rising if even else 1.0)
    work[FALLING + j] = (-beta + falling * gamma) * (falling if even else 1.0)
    work[LOW + j] = -bound if h < 0.0 else 0.0
    work[HIGH + j] = bound if h > 0.0 else 0.0


@njit(forceinline=True, error_model="numpy")
def outside(work, j):  # type: ignore[no-untyped-def]
    """Does a lane's h want `mended`?"""
    return not ((work[H + j] >= work[LOW + j]) & (work[H + j] <= work[HIGH + j]))


@njit(cache=True, error_model="numpy")
def mended(work: Array, lanes: np.uint64, n: float, special: int = LANES) -> bool:
    """Repeat the increment for the lanes whose h crossed 0 on it, or is NaN as it was too long; cut the ones that
    ran away -> whether it was too long for one. special : how many there are at most, after which none is sought"""
    long, left = False, special
    for j in range(lanes):
        if outside(work, j):
            new = work[H + j]
            lost = new != new
            drive, beta, gamma, bound = work[DRIVE + j], work[BETA + j], work[GAMMA + j], work[BOUND + j]
            mirror = 1.0 if drive >= 0.0 else -1.0
            toward = mirror if work[STEP + j] >= 0.0 else -mirror
            g, free, width = toward * work[OLD + j], toward * new, abs(work[STEP + j])
            onward = g != 0.0 and (g < 0.0) == (free < 0.0)  # else a step for n > 1 went from rest, or past a pole
            if n == 1.0 and g <= 0.0 < free:  # a way back may round to exactly 0, whose side is the one before
                free = regrown(g, abs(drive), beta + mirror * gamma, beta - mirror * gamma, width)
            elif lost or g < 0.0 < free or (n > 1.0 and not onward):
                free = grown(g, abs(drive), beta + mirror * gamma, beta - mirror * gamma, n, width, bound)
            work[H + j] = toward * min(max(free, -bound), bound)
            if lost or g <= 0.0 or free <= 0.0:
                _sided(work, np.uint64(j), n)
            long = long or lost
            left -= 1
            if left == 0:
                break
    return long


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(work, j, rate, step, asked):  # type: ignore[no-untyped-def]
    """h of one lane after an increment, by the series; NaN where it is `asked` whether that is too long, and it is
    -> 1 where that wants `mended`."""
    h = work[H + j]
    new = relaxed(h, work[DRIVE + j], rate, step * series(rate * step))
    work[OLD + j] = h
    work[H + j] = np.nan if asked and abs(rate * step) > SERIES_LIMIT else new
    return 1 if outside(work, j) else 0


@njit(cache=True, error_model="numpy")
def _coarse(work: Array, lanes: np.uint64, largest: float) -> int:
    """h after increments of any width, one for each lane: the series on a part of the increment that
    is short enough, then doubled. largest : of |rate step| in all lanes -> number of lanes that want `mended`."""
    doublings = 0
    scale = 1.0
    while largest * scale > SERIES_LIMIT:
        doublings += 1
        scale *= 0.5
    for j in range(lanes):
        rising, falling = work[RISING + j], work[FALLING + j]
        rate = rising if work[STEP + j] >= 0.0 else falling
        part = work[STEP + j] * scale
        work[WEAKENED + j] = part * series(rate * part)
    for _ in range(doublings):  # (1 - e^-2x) / rate = f (2 - rate f), which loses no digits
        for j in range(lanes):
            rising, falling = work[RISING + j], work[FALLING + j]
            rate = rising if work[STEP + j] >= 0.0 else falling
            work[WEAKENED + j] *= 2.0 - rate * work[WEAKENED + j]
    special = 0
    for j in range(lanes):
        h, rising, falling = work[H + j], work[RISING + j], work[FALLING + j]
        rate = rising if work[STEP + j] >= 0.0 else falling
        work[OLD + j] = h
        work[H + j] = relaxed(h, work[DRIVE + j], rate, max(min(work[WEAKENED + j], HUGE), -HUGE))
        special += 1 if outside(work, j) else 0
    return special


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _side_by_side(u: Array, lengths: Array, p: tuple[Array, Array, Array, Array], v: Array, first: int) -> None:
    """As `bouc_wen`, for the LANES particles from `first` on, into v. lengths : `paths` of u;  p : alpha to d

    Those that pad them read and write what follows in u and v, but for the last sample.
    """
    samples, swarm = v.shape
    shared = u.shape[1] == 1
    inputs, outputs = u.ravel(), v.reshape(samples * swarm)
    used = min(LANES, swarm - first)
    full = -(-used // FULL) * FULL if used > FEW else used
    work = np.zeros(ROWS * LANES)
    fastest, long = 0.0, False
    for k in range(first, first + used):
        x, length = (u[0, 0], lengths[0]) if shared else (u[0, k], lengths[k])
        fastest = max(fastest, prepared(work, np.uint64(k - first), p, k, (x, length, 1.0)))
        v[0, k] = p[3][k] * x
    for i in range(1, samples):
        lanes = np.uint64(full if i + 1 < samples else used)
        row = np.uint64(i * swarm + first)
        special = 0
        if not shared:
            if long:
                widest = np.int64(0)  # the bits of |step|, in its order; unlike it compared side by side
                for j in range(lanes):
                    now = inputs[row + j]
                    step = now - work[INPUT + j]
                    work[STEP + j] = step
                    work[INPUT + j] = now
                    widest = max(widest, np.float64(abs(step)).view(np.int64))
                special = _coarse(work, lanes, fastest * np.int64(widest).view(np.float64))
                for j in range(lanes):
                    outputs[row + j] = work[SLOPE + j] * work[INPUT + j] - work[H + j]
            else:
                for j in range(lanes):
                    now, rising, falling = inputs[row + j], work[RISING + j], work[FALLING + j]
                    step = now - work[INPUT + j]
                    work[STEP + j] = step
                    work[INPUT + j] = now
                    special += _advanced(work, j, rising if step >= 0.0 else falling, step, True)
                    outputs[row + j] = work[SLOPE + j] * now - work[H + j]
            if special > 0:
                long = mended(work, lanes, 1.0, special) or long
                for j in range(lanes):
                    outputs[row + j] = work[SLOPE + j] * work[INPUT + j] - work[H + j]
            continue

        x = u[i, 0]
        step = x - u[i - 1, 0]
        if fastest * abs(step) > SERIES_LIMIT:
            work[STEP : STEP + lanes] = step
            special = _coarse(work, lanes, fastest * abs(step))
            for j in range(lanes):
                outputs[row + j] = work[SLOPE + j] * x - work[H + j]
        elif step >= 0.0:
            for j in range(lanes):
                special += _advanced(work, j, work[RISING + j], step, False)
                outputs[row + j] = work[SLOPE + j] * x - work[H + j]
        else:
            for j in range(lanes):
                special += _advanced(work, j, work[FALLING + j], step, False)
                outputs[row + j] = work[SLOPE + j] * x - work[H + j]
        if special > 0:
            work[STEP : STEP + lanes] = step
            mended(work, lanes, 1.0, special)
            for j in range(lanes):
                outputs[row + j] = work[SLOPE + j] * x - work[H + j]


@njit(cache=True, error_model="numpy")
def bouc_wen(u: Array, alpha: Array, beta: Array, gamma: Array, d: Array) -> Array:
    """Bouc-Wen with n = 1, exact on every increment of the input.

    u : float64[samples, 1] shared by the swarm, or float64[samples, swarm]    input
    alpha : float64[swarm]          height of the loop against the linear response, 1
    beta, gamma : float64[swarm]    shape of the loop, 1 / unit of u, any sign
    d : float64[swarm]              linear response, unit of v / unit of u
    -> float64[samples, swarm]      v = d u - h; finite: see RUNAWAY

    [1] eq. (1)  Ours: h = 0 at the first sample, so v(0) = d u(0).
    """
    lengths = np.full(u.shape[1], np.inf) if bounded(alpha, beta, gamma, d) else paths(u)
    v = np.empty((u.shape[0], d.size))
    for first in range((d.size - 1) // LANES * LANES, -1, -LANES):  # the last ones first, for their padding
        _side_by_side(u, lengths, (alpha, beta, gamma, d), v, first)
    return v

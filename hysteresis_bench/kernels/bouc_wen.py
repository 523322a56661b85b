"""Bouc-Wen hysteresis of a swarm, integrated over increments of the input: rate-independent to rounding.

`bouc_wen_step` has the law and its step for one particle. Its exponentials and branches keep a loop over a swarm
from being vectorised, so `bouc_wen` makes the same step by a series of the exponential, side by side for all
particles, and the step of `bouc_wen_step` only for those whose h crosses 0 or runs away: 18 times as fast.

[1] The PEA paper: a particle swarm genetic hybrid to identify a Hammerstein model, equation (1).
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen_step import HUGE, RUNAWAY, regrown, relaxed

SERIES_LIMIT = 0.25
"""Largest |rate w| for the series of (1 - exp(-x)) / x below; its first neglected term is 2.4e-14 there."""

LANES = 64
"""Particles that are integrated side by side."""

FULL = 8
"""Particles on a shared input are integrated in multiples of this many, those that pad them at rest: a loop over
what is left of a vector takes longer than one over all of it, but for FEW particles."""
FEW = 3

# Rows of one work array: constant offsets tell the compiler that they do not overlap.
G, OLD, WIDTH, WEAKENED, DRIVE, ALONG, AGAINST, BOUND, SLOPE, MIRROR, DIRECTION, OUT = (
    row * LANES for row in range(12)
)
ROWS = 12


@njit(cache=True, error_model="numpy", fastmath=True)
def paths(u: Array) -> tuple[Array, Array]:
    """Of every column of u, float64[samples, columns]: the path's length and the largest increment."""
    samples, columns = u.shape
    length = np.zeros(columns)
    largest = np.zeros(columns)
    if columns == 1:  # scalars, so that the loop over the samples is vectorised instead
        shared, total, most = u[:, 0].copy(), 0.0, 0.0
        for i in range(1, samples):
            width = abs(shared[i] - shared[i - 1])
            total += width
            most = max(most, width)
        length[0], largest[0] = total, most
        return length, largest
    for i in range(1, samples):
        for j in range(columns):
            width = abs(u[i, j] - u[i - 1, j])
            length[j] += width
            largest[j] = max(largest[j], width)
    return length, largest


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def series(x):  # type: ignore[no-untyped-def]
    """(1 - exp(-x)) / x for |x| <= SERIES_LIMIT, in an order that a processor can overlap."""
    x2 = x * x
    x4 = x2 * x2
    first = (1.0 - x * (1.0 / 2.0)) + x2 * (1.0 / 6.0 - x * (1.0 / 24.0))
    middle = (1.0 / 120.0 - x * (1.0 / 720.0)) + x2 * (1.0 / 5040.0 - x * (1.0 / 40320.0))
    last = 1.0 / 362880.0 - x * (1.0 / 3628800.0)
    return (first + x4 * middle) + (x4 * x4) * last


@njit(cache=True, error_model="numpy")
def _coarse(work: Array, used: int, largest: float) -> int:
    """Advance g by increments of any width, one for each lane: the series on a part of the increment that
    is short enough, then doubled. largest : of |rate w| in all lanes -> number of lanes that want `_mended`."""
    doublings = 0
    scale = 1.0
    while largest * scale > SERIES_LIMIT:
        doublings += 1
        scale *= 0.5
    for j in range(used):
        along = work[ALONG + j]
        against = work[AGAINST + j]
        rate = against if work[G + j] < 0.0 else along
        part = work[WIDTH + j] * scale
        work[WEAKENED + j] = part * series(rate * part)
    for _ in range(doublings):  # (1 - e^-2x) / rate = f (2 - rate f), which loses no digits
        for j in range(used):
            along = work[ALONG + j]
            against = work[AGAINST + j]
            rate = against if work[G + j] < 0.0 else along
            work[WEAKENED + j] *= 2.0 - rate * work[WEAKENED + j]
    special = 0
    for j in range(used):
        g = work[G + j]
        along = work[ALONG + j]
        against = work[AGAINST + j]
        rate = against if g < 0.0 else along
        free = relaxed(g, work[DRIVE + j], rate, min(work[WEAKENED + j], HUGE))
        work[OLD + j] = g
        work[G + j] = free
        special += 1 if ((g < 0.0) & (free > 0.0)) | (abs(free) > work[BOUND + j]) else 0
    return special


@njit(cache=True, error_model="numpy")
def _mended(work: Array, used: int) -> None:
    """Repeat the increment for the lanes whose g crossed 0 on it; cut the ones that ran away."""
    for j in range(used):
        if work[OLD + j] < 0.0 and work[G + j] > 0.0:
            along, against = work[ALONG + j], work[AGAINST + j]
            work[G + j] = regrown(work[OLD + j], work[DRIVE + j], along, against, work[WIDTH + j])
        work[G + j] = min(max(work[G + j], -work[BOUND + j]), work[BOUND + j])


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _fine(work, j, g, width):  # type: ignore[no-untyped-def]
    """g of one lane after an increment that is short enough for the series."""
    along = work[ALONG + j]
    against = work[AGAINST + j]
    rate = against if g < 0.0 else along
    return relaxed(g, work[DRIVE + j], rate, width * series(rate * width))


@njit(inline="always", error_model="numpy")
def _turned(work, j, step):  # type: ignore[no-untyped-def]
    """g = s h of one lane changes sign with s, the direction of the input."""
    mirror = work[MIRROR + j]
    direction = mirror if step >= 0.0 else -mirror
    g = work[G + j] * work[DIRECTION + j]
    work[DIRECTION + j] = direction
    return g * direction


@njit(cache=True, error_model="numpy")
def _faced(work: Array, now: Array, before: Array) -> None:
    """From h to g in the direction of each lane's own input, which goes from `before` to `now`."""
    for j in range(now.size):
        step = now[j] - before[j]
        work[DIRECTION + j] = 1.0 if step >= 0.0 else -1.0
        work[G + j] *= work[DIRECTION + j]
        work[WIDTH + j] = abs(step)


@njit(cache=True, error_model="numpy")
def _unfaced(work: Array, used: int) -> None:
    for j in range(used):
        work[G + j] *= work[DIRECTION + j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _side_by_side(
    u: Array, moved: tuple[Array, Array], shared: bool, p: tuple[Array, Array, Array, Array], v: Array
) -> None:
    """As `bouc_wen`, for LANES particles at most, into v. moved : `paths` of u;  p : alpha, beta, gamma, d

    Loops run over columns from the first one on, as an index that might be negative keeps them from being vectorised;
    a shared input's go by the work array, as one that writes into v makes a swarm of one wait.
    """
    alpha, beta, gamma, d = p
    length, largest = moved
    samples, used = v.shape
    full = -(-used // FULL) * FULL if used > FEW else used
    work = np.zeros(ROWS * LANES)
    fastest = 0.0
    widest = 0.0
    rising = True
    for j in range(used):
        column = 0 if shared else j
        loop = alpha[j] * d[j]
        mirror = 1.0 if loop >= 0.0 else -1.0
        work[DRIVE + j] = abs(loop)
        work[ALONG + j] = beta[j] + mirror * gamma[j]
        work[AGAINST + j] = beta[j] - mirror * gamma[j]
        work[BOUND + j] = RUNAWAY * abs(loop) * length[column]
        work[SLOPE + j] = d[j]
        work[MIRROR + j] = mirror
        work[DIRECTION + j] = mirror
        widest = max(widest, largest[column])
        fastest = max(fastest, max(abs(work[ALONG + j]), abs(work[AGAINST + j])))
        v[0, j] = d[j] * u[0, column]
    for i in range(1, samples):
        steepest = fastest * (abs(u[i, 0] - u[i - 1, 0]) if shared else widest)
        special = 0
        if not shared:  # G holds h without the mirror's sign: a lane turns whenever its own input does
            if steepest > SERIES_LIMIT:
                _faced(work, u[i], u[i - 1])
                special = _coarse(work, used, steepest)
                _unfaced(work, used)
                for j in range(used):
                    v[i, j] = work[SLOPE + j] * u[i, j] - work[MIRROR + j] * work[G + j]
            else:
                for j in range(used):
                    x = u[i, j]
                    step = x - u[i - 1, j]
                    direction = 1.0 if step >= 0.0 else -1.0
                    g = work[G + j] * direction
                    free = _fine(work, j, g, abs(step))
                    h = free * direction
                    work[OLD + j] = g
                    work[G + j] = h
                    v[i, j] = work[SLOPE + j] * x - work[MIRROR + j] * h
                    special += 1 if ((g < 0.0) & (free > 0.0)) | (abs(free) > work[BOUND + j]) else 0
            if special > 0:
                _faced(work, u[i], u[i - 1])
                _mended(work, used)
                _unfaced(work, used)
                for j in range(used):
                    v[i, j] = work[SLOPE + j] * u[i, j] - work[MIRROR + j] * work[G + j]
            continue

        x = u[i, 0]
        step = x - u[i - 1, 0]
        width = abs(step)
        if (step < 0.0) == rising and step != 0.0:
            rising = not rising
            for j in range(full):
                work[G + j] = _turned(work, j, step)
        if steepest > SERIES_LIMIT:
            work[WIDTH : WIDTH + full] = width
            special = _coarse(work, full, steepest)
            for j in range(full):
                work[OUT + j] = work[SLOPE + j] * x - work[DIRECTION + j] * work[G + j]
        else:  # the same in one pass
            for j in range(full):
                g = work[G + j]
                free = _fine(work, j, g, width)
                work[OLD + j] = g
                work[G + j] = free
                work[OUT + j] = work[SLOPE + j] * x - work[DIRECTION + j] * free
                special += 1 if ((g < 0.0) & (free > 0.0)) | (abs(free) > work[BOUND + j]) else 0
        if special > 0:
            work[WIDTH : WIDTH + full] = width
            _mended(work, full)
            for j in range(full):
                work[OUT + j] = work[SLOPE + j] * x - work[DIRECTION + j] * work[G + j]
        for j in range(used):
            v[i, j] = work[OUT + j]


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
    samples, columns = u.shape
    swarm = d.size
    shared = columns == 1
    length, largest = paths(u)
    v = np.empty((samples, swarm))
    if swarm <= LANES:
        _side_by_side(u, (length, largest), shared, (alpha, beta, gamma, d), v)
        return v
    for first in range(0, swarm, LANES):
        part = slice(first, min(first + LANES, swarm))
        some = np.empty((samples, d[part].size))
        own = u if shared else u[:, part].copy()
        moved = (length, largest) if shared else (length[part], largest[part])
        _side_by_side(own, moved, shared, (alpha[part], beta[part], gamma[part], d[part]), some)
        v[:, part] = some
    return v

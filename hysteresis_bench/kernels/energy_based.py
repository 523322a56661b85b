"""Energy-based hysteresis of a swarm: cells with dry friction in the field, behind a mean field.

Every cell has the anhysteretic curve of its reversible field, which follows the acting field as a play with the cell's
pinning as half-width; the acting field is the input and what the mean magnetization adds,

    h = u + 3 a coupling m,    m = sum of shares_k L(P_k[h] / a),    L the Langevin function.

For coupling < 1 the second equation has one solution m for every state of the plays, as its right side less m falls
everywhere: Newton's method from where the last two slopes lead, between the bounds that its signs tell. Where no play
starts or stops on the way, the last step leaves an error of its square, which is told from its length.

[1] A. Bergqvist, Physica B 233 (1997) 342.
[2] F. Henrotte, A. Nicolet, K. Hameyer, COMPEL 25 (2006) 71.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.lanes import LANES
from hysteresis_bench.kernels.langevin import langevin_ratio
from hysteresis_bench.kernels.play import played

CLOSE = 1e-12
"""Error of m at which it counts as found."""
MOST_STEPS = 60
STEEPEST = 0.99999
"""Slope of the right side in m beyond which a step is no longer lengthened."""
CURVED = 0.48
"""Half the largest second derivative of the right side in m, 9 coupling^2 L'' with |L''| < 0.106."""
RISE = 1 / 3
"""Slope of L at 0."""

# Rows of a group: what does not change, the state with the last step, and the search for m.
FIELD, INVERSE, NOW, NEXT, M, LAST, STEADY, RATE, BEFORE = (row * LANES for row in range(9))
LOW, HIGH, CHANGE, LEFT, OPEN, FOUND, SLOPE, OFF = (row * LANES for row in range(9, 17))
PINNING, SHARE, PLACE = (row * LANES for row in range(17, 20))
"""The cell in hand."""
CELL = 3 * LANES
ROWS = 20


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _begun(s):  # type: ignore[no-untyped-def]
    """m where its last slopes lead, unless the input has turned."""
    for j in range(min(LANES, s.size & -LANES)):
        step, last, rate, m = s[NEXT + j] - s[NOW + j], s[LAST + j], s[RATE + j], s[M + j]
        steady = step * last > 0.0
        bend = 0.5 * (rate - s[BEFORE + j]) / last if s[STEADY + j] > 0.0 else 0.0
        guess = m + (rate + bend * step) * step
        s[M + j] = guess if steady & (abs(guess) <= 1.0) else m
        s[NOW + j], s[LAST + j], s[BEFORE + j] = s[NEXT + j], step, rate
        s[STEADY + j] = 1.0 if steady else 0.0
        s[LOW + j], s[HIGH + j], s[OPEN + j] = -1.0, 1.0, 1.0
        s[FOUND + j], s[SLOPE + j] = 0.0, 0.0


@njit(forceinline=True, error_model="numpy")
def _taken(s, cell):  # type: ignore[no-untyped-def]
    """A cell copied to its group: where rows may lie anywhere, loops over lanes are not vectorised."""
    for j in range(min(CELL, cell.size & -LANES)):
        s[PINNING + j] = cell[j]


@njit(forceinline=True, error_model="numpy")
def _put_back(s, cell):  # type: ignore[no-untyped-def]
    for j in range(min(CELL, cell.size & -LANES)):
        cell[j] = s[PINNING + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _added(s):  # type: ignore[no-untyped-def]
    """The magnetization of the cell in hand, and its slope in h / a."""
    for j in range(min(LANES, s.size & -LANES)):
        before, share = s[PLACE + j], s[SHARE + j]
        place = played(s[NOW + j] + s[FIELD + j] * s[M + j], s[PINNING + j], before)
        x = place * s[INVERSE + j]
        ratio = langevin_ratio(x)
        L = x * ratio
        moved = share if place != before else 0.0
        s[FOUND + j] += share * L
        s[SLOPE + j] += moved * (1.0 - L * L - 2.0 * ratio)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _stepped(s):  # type: ignore[no-untyped-def]
    """A step of the lanes that are open, closed where what it leaves is small."""
    for j in range(min(LANES, s.size & -LANES)):
        m, is_open = s[M + j], s[OPEN + j] > 0.0
        excess = s[FOUND + j] - m
        low = m if excess >= 0.0 else s[LOW + j]
        high = m if excess <= 0.0 else s[HIGH + j]
        slope = s[SLOPE + j] * s[INVERSE + j]
        left = 1.0 - min(s[FIELD + j] * slope, STEEPEST)
        new = m + excess / left
        new = new if (new >= low) & (new <= high) else 0.5 * (low + high)
        change = new - m
        near = (CURVED * change * change <= CLOSE * left) | (abs(change) <= CLOSE)
        s[LOW + j], s[HIGH + j] = low, high
        s[M + j] = new if is_open else m
        s[CHANGE + j] = change if is_open else s[CHANGE + j]
        s[LEFT + j] = left if is_open else s[LEFT + j]
        s[RATE + j] = slope / left if is_open else s[RATE + j]
        s[OPEN + j] = 1.0 if is_open & (not near) else 0.0
        s[FOUND + j], s[SLOPE + j], s[OFF + j] = 0.0, 0.0, 0.0


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _followed(s):  # type: ignore[no-untyped-def]
    """The play of the cell in hand moved on, and by how much the last step had it elsewhere."""
    for j in range(min(LANES, s.size & -LANES)):
        before, pinning = s[PLACE + j], s[PINNING + j]
        h, step = s[NOW + j] + s[FIELD + j] * s[M + j], s[FIELD + j] * s[CHANGE + j]
        tried = played(h - step, pinning, before)
        place = played(h, pinning, before)
        told = tried + (step if tried != before else 0.0)
        s[OFF + j] += s[SHARE + j] * abs(place - told)
        s[PLACE + j] = place


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _opened(s):  # type: ignore[no-untyped-def]
    """Lanes open again where plays that started or stopped in the last step matter."""
    for j in range(min(LANES, s.size & -LANES)):
        error = RISE * s[INVERSE + j] * s[OFF + j]
        s[OPEN + j] = 1.0 if (error > CLOSE * s[LEFT + j]) & (abs(s[CHANGE + j]) > CLOSE) else 0.0


@njit(forceinline=True, error_model="numpy")
def _going(s):  # type: ignore[no-untyped-def]
    """How many lanes are open."""
    going = 0
    for j in range(min(LANES, s.size & -LANES)):
        going += 1 if s[OPEN + j] > 0.0 else 0
    return going


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def magnetized_together(s: Array, cells: Array, after: Array) -> None:
    """m of a group at the input s[NEXT:].

    cells : float64[cells, CELL]    pinning, share and place of each play
    after : like cells              written: with the places of now
    """
    _begun(s)
    for step in range(1, MOST_STEPS + 1):
        for k in range(cells.shape[0]):
            _taken(s, cells[k])
            _added(s)
        _stepped(s)
        if (_going(s) > 0) & (step < MOST_STEPS):
            continue
        for k in range(cells.shape[0]):
            _taken(s, cells[k])
            _followed(s)
            _put_back(s, after[k])
        _opened(s)
        if _going(s) == 0:
            return


@njit(cache=True, error_model="numpy")
def _filled(cells: Array, row: int, values: Array, members: Array) -> None:
    for k in range(cells.shape[0]):
        for j in range(LANES):
            cells[k, row * LANES + j] = values[k, members[j]]


@njit(cache=True, error_model="numpy")
def energy_based(u: Array, a: Array, coupling: Array, pinning: Array, shares: Array) -> Array:
    """The mean magnetization over saturation.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    a : float64[swarm]                  form factor of the anhysteretic curve, unit of u, > 0
    coupling : float64[swarm]           mean field over what makes the curve upright, 0 to below 1
    pinning : float64[cells, swarm]     unit of u, >= 0
    shares : float64[cells, swarm]      of the cells, >= 0, sum 1
    -> float64[samples, swarm]          -1 to 1; on the anhysteretic curve at the first sample
    """
    samples, columns = u.shape
    count, swarm = shares.shape
    alike = np.argsort(coupling)
    out = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        members = np.array([alike[first + min(j, used - 1)] for j in range(LANES)])
        s = np.zeros(ROWS * LANES)
        cells, after = np.zeros((count, CELL)), np.zeros((count, CELL))
        for j in range(LANES):
            s[FIELD + j], s[INVERSE + j] = 3.0 * a[members[j]] * coupling[members[j]], 1.0 / a[members[j]]
        _filled(cells, 1, shares, members)
        for i in range(samples):
            for j in range(LANES):
                s[NEXT + j] = u[i, members[j] if columns > 1 else 0]
            magnetized_together(s, cells, after)
            cells, after = after, cells
            if i == 0:
                _filled(cells, 0, pinning, members)
            for j in range(used):
                out[i, members[j]] = s[M + j]
    return out

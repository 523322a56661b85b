"""Joints side by side: where each goes, and which of them were turned round, or further out than ever before.

A group is one array of rows of LANES, those below and then the law's own. X is the largest displacement of a reversal
on a side, x the displacement over u_y; both are counted in the direction of the increment.
"""

from __future__ import annotations

from numba import njit

LANES = 16
"""Joints side by side; a swarm is padded to a multiple with copies of its last one. With 8 a processor waits for
results of its own: pinching then takes 7.6 ns a particle and sample for 5.4."""

YIELD, INPUT, NEW, TOWARD, X, SENSE, OWN, OTHER, EXTREME = (row * LANES for row in range(9))
"""u_y; displacement from the first one; that over u_y, and the direction that leads there; x and the direction before;
X of the side to which it goes, and of the other; the new X of the other side where this reversal made it one, or 0."""
LAW = 9
"""First row of the law."""


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def begun(s):  # type: ignore[no-untyped-def]
    """Where x goes, and in which direction."""
    for j in range(min(LANES, s.size)):
        new = s[INPUT + j] / s[YIELD + j]
        step = new - s[X + j]
        side = -1.0 if step < 0.0 else s[SENSE + j]
        s[NEW + j], s[TOWARD + j] = new, 1.0 if step > 0.0 else side


@njit(forceinline=True, error_model="numpy")
def turning(s):  # type: ignore[no-untyped-def]
    """How many lanes turn round."""
    count = 0
    for j in range(min(LANES, s.size)):
        count += 1 if s[TOWARD + j] != s[SENSE + j] else 0
    return count


@njit(forceinline=True, error_model="numpy")
def swapped(s, j, row, other, turned, sign):  # type: ignore[no-untyped-def]
    """Two rows of a lane, one times the sign of the other, where it has turned."""
    first, second = s[row + j], s[other + j]
    s[row + j], s[other + j] = sign * second if turned else first, sign * first if turned else second


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def turned_round(s, j, turned):  # type: ignore[no-untyped-def]
    """A lane goes in its new direction, its sides swapped; whether it had gone further than ever stands in EXTREME."""
    swapped(s, j, OWN, OTHER, turned, 1.0)
    extreme = -s[TOWARD + j] * s[X + j]
    s[EXTREME + j] = extreme if turned & (extreme > s[OTHER + j]) else 0.0
    s[SENSE + j] = s[TOWARD + j]


@njit(forceinline=True, error_model="numpy")
def reaching(s):  # type: ignore[no-untyped-def]
    """How many lanes turned further out than ever before."""
    count = 0
    for j in range(min(LANES, s.size)):
        count += 1 if s[EXTREME + j] > 0.0 else 0
    return count


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def given(s, u, i, first, used):  # type: ignore[no-untyped-def]
    """Sample i of the input, of the `first` particle and the `used` that follow, copies of the last after them."""
    if u.shape[1] == 1:
        shared = u[i, 0] - u[0, 0]
        for j in range(min(LANES, s.size)):
            s[INPUT + j] = shared
    else:
        for j in range(LANES):
            column = first + min(j, used - 1)
            s[INPUT + j] = u[i, column] - u[0, column]

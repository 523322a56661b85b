"""The force of a swarm between two curves that meet in the centre: a flag-shaped loop.

With w = u - centre, a spring of unit slope moves between the way E(|w|, bend) on which the force grows and the way
E(|w|, return) on which it goes back, E(w, c) = c e(w / c) with e as of `rounded_corner`, on each side of the centre:

    |x| follows |w| step for step, E(|w|, return) <= |x| <= E(|w|, bend),    F = side x + slope w,

side the stiffness above the centre or below it. Neither curve is steeper than the spring: an increment of the
displacement, cut at the centre, is exact whatever its length.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, given_to_lanes, taken_in
from hysteresis_bench.kernels.lanes import LANES
from hysteresis_bench.kernels.rounded_corner import bent

NARROWEST = 1e-12
"""Of the bend, the least return: a force that is gone on the way back."""

# Rows of a group: the parameters as in `flag_shaped`, 1 over m; then the displacement, w, x and F.
CENTRE, BEND, RETURN, SHARPNESS, UP, DOWN, SLOPE, ROOT = (row * LANES for row in range(8))
NOW, WAY, X, FORCE = (row * LANES for row in range(8, 12))
ROWS = 12


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def moved_together(s: Array) -> None:
    """A group, one increment on."""
    for j in range(min(LANES, s.size & -LANES)):
        m, root = s[SHARPNESS + j], s[ROOT + j]
        now, before, x = s[NOW + j] - s[CENTRE + j], s[WAY + j], s[X + j]
        crossed = now * before < 0.0
        size = abs(now)
        free = (0.0 if crossed else abs(x)) + size - (0.0 if crossed else abs(before))
        most, least = s[BEND + j], s[RETURN + j]
        way = max(min(free, most * bent(size / most, m, root)), least * bent(size / least, m, root))
        s[WAY + j], s[X + j] = now, way if now >= 0.0 else -way
        s[FORCE + j] = s[X + j] * (s[UP + j] if now >= 0.0 else s[DOWN + j]) + s[SLOPE + j] * now


@njit(cache=True, error_model="numpy")
def flag_shaped(u: Array, parameters: Array, force: Array) -> None:
    """The force F, from rest in the centre.

    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    parameters : float64[7, swarm]    centre, unit of u; bend > 0, unit of u; return, from 0 to 1 of the bend; m > 0;
        up, down and slope, unit of F over that of u
    force : float64[samples, swarm]    overwritten with F
    """
    samples, swarm = force.shape
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        given_to_lanes(s, parameters, first, used)
        for j in range(LANES):
            s[RETURN + j] = s[BEND + j] * max(s[RETURN + j], NARROWEST)
            s[ROOT + j] = 1.0 / s[SHARPNESS + j]
        for i in range(samples):
            taken_in(s, NOW, u, i, first, used)
            moved_together(s)
            given_out(s, FORCE, force, i, first, used)

"""The force of a swarm that comes back to its centre: an elastic curve that bends once on either side, and what yields.

With w = u - centre, x = w / bend, M the largest |x| so far on the side of w, and z the force of what yields over its
strength,

    F = up max(w, 0) + down min(w, 0) + (corner - loss M^power) e(x) + strength z,    e as of `rounded_corner`.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, given_to_lanes, taken_in
from hysteresis_bench.kernels.elementary import base_2_logarithm, power_of_2
from hysteresis_bench.kernels.lanes import LANES
from hysteresis_bench.kernels.rounded_corner import LEAST, bent

# Rows of a group: the parameters as in `self_centring`, 1 over bend and over m; then u, z, F and M of either side.
CENTRE, BEND, SHARPNESS, UP, DOWN, CORNER, STRENGTH, LOSS, POWER = (row * LANES for row in range(9))
STEEPNESS, ROOT, NOW, Z, FORCE, ABOVE, BELOW = (row * LANES for row in range(9, 16))
ROWS = 16


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def forced_together(s: Array) -> None:
    """F of a group."""
    for j in range(min(LANES, s.size & -LANES)):
        way, up, down = s[NOW + j] - s[CENTRE + j], s[UP + j], s[DOWN + j]
        elastic = way * (up if way >= 0.0 else down)
        x = way * s[STEEPNESS + j]
        s[ABOVE + j], s[BELOW + j] = max(s[ABOVE + j], x), max(s[BELOW + j], -x)
        reached = max(s[ABOVE + j] if x >= 0.0 else s[BELOW + j], LEAST)
        corner = s[CORNER + j] - s[LOSS + j] * power_of_2(s[POWER + j] * base_2_logarithm(reached))
        level = bent(x, s[SHARPNESS + j], s[ROOT + j])
        s[FORCE + j] = s[STRENGTH + j] * s[Z + j] + elastic + corner * level


@njit(cache=True, error_model="numpy")
def self_centring(u: Array, z: Array, parameters: Array) -> None:
    """The force F.

    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    z : float64[samples, swarm]                           overwritten with F
    parameters : float64[9, swarm]    centre, unit of u; bend > 0, unit of u; m > 0; up and down, unit of F over that
        of u; corner, strength and loss, unit of F; power > 0
    """
    samples, swarm = z.shape
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        given_to_lanes(s, parameters, first, used)
        for j in range(LANES):
            s[STEEPNESS + j], s[ROOT + j] = 1.0 / s[BEND + j], 1.0 / s[SHARPNESS + j]
        for i in range(samples):
            taken_in(s, NOW, u, i, first, used)
            taken_in(s, Z, z, i, first, used)
            forced_together(s)
            given_out(s, FORCE, z, i, first, used)

"""Columns of an array into a row of a group of particles side by side, and out of it.

Of a row with fewer columns than LANES the last one fills the lanes that are left. The loops over all lanes tell the
compiler twice as many as there are: one that is known to be short is unrolled and then copies number by number, which
takes as long as a law's step for the whole group.
"""

from __future__ import annotations

from numba import njit

from hysteresis_bench.kernels.lanes import LANES


@njit(forceinline=True, error_model="numpy")
def taken_in(s, row, u, i, first, used):  # type: ignore[no-untyped-def]
    """s[row:] from sample i of u, (samples, 1) or (samples, swarm), from column `first` on."""
    if u.shape[1] == 1:
        value = u[i, 0]
        for j in range(min(2 * LANES, s[:LANES].size & -LANES)):
            s[row + j] = value
    elif used == LANES:
        values = u[i, first : first + LANES]
        for j in range(min(2 * LANES, values.size & -LANES)):
            s[row + j] = values[j]
    else:
        for j in range(LANES):
            s[row + j] = u[i, first + min(j, used - 1)]


@njit(forceinline=True, error_model="numpy")
def given_out(s, row, out, i, first, used):  # type: ignore[no-untyped-def]
    """Sample i of out, (samples, swarm), from column `first` on, from s[row:]."""
    if used == LANES:
        values = out[i, first : first + LANES]
        for j in range(min(2 * LANES, values.size & -LANES)):
            values[j] = s[row + j]
    else:
        for j in range(used):
            out[i, first + j] = s[row + j]


@njit(forceinline=True, error_model="numpy")
def given_to_lanes(s, parameters, first, used):  # type: ignore[no-untyped-def]
    """The first rows of s from all rows of parameters, (rows, swarm), from column `first` on."""
    for j in range(LANES):
        for row in range(parameters.shape[0]):
            s[row * LANES + j] = parameters[row, first + min(j, used - 1)]

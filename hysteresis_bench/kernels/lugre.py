"""LuGre friction of a swarm: bristles that bend and slip, exact for a displacement that is linear between samples.

[1] C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, IEEE Trans. Automatic Control 40 (1995) 419.

With z the bristles' force over Coulomb's, distance = F_C / sigma_0 and r(v) = 1 + (stiction - 1) exp(-(v/v_s)^2), [1]

    distance dz/dt = v - |v| z / r(v)

is linear where v is constant: z goes to s r as exp(-|du| / (r distance)). LANES particles do so side by side; `_excess`
is r for one.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, taken_in
from hysteresis_bench.kernels.elementary import exponential
from hysteresis_bench.kernels.lanes import LANES

LONGEST = 700.0
"""Negative exponent at which an exponential counts as gone."""

# Rows of a group: the parameters; the state; u a sample ago, now, a sample on; what is told.
DISTANCE, STICTION, INVERSE_SLOWEST = (row * LANES for row in range(3))
Z, PAST, NOW, NEXT, BENDING, V = (row * LANES for row in range(3, 9))
ROWS = 9


@njit(forceinline=True, error_model="numpy")
def _excess(stiction, velocity, slowest):  # type: ignore[no-untyped-def]
    """r(v)."""
    share = velocity / slowest
    return 1.0 + (stiction - 1.0) * math.exp(-min(share * share, LONGEST))


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _gone_on(s, rate):  # type: ignore[no-untyped-def]
    """z after the increment, u one sample on;  rate : 1 over the time between."""
    for j in range(min(LANES, s.size & -LANES)):
        step = s[NOW + j] - s[PAST + j]
        share = step * rate * s[INVERSE_SLOWEST + j]
        r = 1.0 + (s[STICTION + j] - 1.0) * exponential(-min(share * share, LONGEST))
        end = r if step >= 0.0 else -r
        s[Z + j] = end + (s[Z + j] - end) * exponential(-abs(step) / (r * s[DISTANCE + j]))


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _bent(s, rate):  # type: ignore[no-untyped-def]
    """v and distance dz/dt;  rate : 1 over the time from the sample before to the one after."""
    for j in range(min(LANES, s.size & -LANES)):
        v = (s[NEXT + j] - s[PAST + j]) * rate
        share = v * s[INVERSE_SLOWEST + j]
        r = 1.0 + (s[STICTION + j] - 1.0) * exponential(-min(share * share, LONGEST))
        s[V + j], s[BENDING + j] = v, v - abs(v) * s[Z + j] / r


@njit(forceinline=True, error_model="numpy")
def _shifted(s):  # type: ignore[no-untyped-def]
    for j in range(min(LANES, s.size & -LANES)):
        s[PAST + j], s[NOW + j] = s[NOW + j], s[NEXT + j]


@njit(cache=True, error_model="numpy")
def lugre(
    time: Array, timed: bool, u: Array, distance: Array, stiction: Array, slowest: Array
) -> tuple[Array, Array, Array]:
    """Bristles and velocities.

    time : float64[samples]        strictly increasing
    timed : False where time is only an index: then v counts as fast, r = 1, and what is made of rates is 0
    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    distance : float64[swarm]      over which bristles bend until they slip, unit of u, > 0
    stiction : float64[swarm]      static over Coulomb friction, > 0
    slowest : float64[swarm]       Stribeck velocity v_s, unit of u over that of time, > 0
    -> three float64[samples, swarm]: z, 0 at the first sample; distance dz/dt; v, by central differences at the samples
    """
    samples, swarm = u.shape[0], distance.size
    z, bending, v = np.zeros((samples, swarm)), np.zeros((samples, swarm)), np.zeros((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        for j in range(LANES):
            one = first + min(j, used - 1)
            s[DISTANCE + j], s[STICTION + j] = distance[one], stiction[one] if timed else 1.0
            s[INVERSE_SLOWEST + j] = 1.0 / slowest[one]
        taken_in(s, NEXT, u, 0, first, used)
        _shifted(s)
        for i in range(samples):
            before, after = max(i - 1, 0), min(i + 1, samples - 1)
            _shifted(s)
            taken_in(s, NEXT, u, after, first, used)
            if i > 0:
                _gone_on(s, 1.0 / (time[i] - time[before]))
                given_out(s, Z, z, i, first, used)
            if timed and samples > 1:
                _bent(s, 1.0 / (time[after] - time[before]))
                given_out(s, V, v, i, first, used)
                given_out(s, BENDING, bending, i, first, used)
    return z, bending, v

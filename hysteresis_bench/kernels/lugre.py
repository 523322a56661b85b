"""LuGre friction of a swarm: bristles that bend and slip, exact for a displacement that is linear between samples.

[1] C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, IEEE Trans. Automatic Control 40 (1995) 419.

With z the bristles' force over Coulomb's, distance = F_C / sigma_0 and r(v) = 1 + (stiction - 1) exp(-(v/v_s)^2), [1]

    distance dz/dt = v - |v| z / r(v)

is linear where v is constant: z goes to s r as exp(-|du| / (r distance)).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(forceinline=True, error_model="numpy")
def _excess(stiction, velocity, slowest):  # type: ignore[no-untyped-def]
    """r(v)."""
    share = velocity / slowest
    return 1.0 + (stiction - 1.0) * math.exp(-min(share * share, 700.0))


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
    samples, columns = u.shape
    swarm = distance.size
    z = np.zeros((samples, swarm))
    bending = np.zeros((samples, swarm))
    v = np.zeros((samples, swarm))
    for j in range(swarm):
        column = j if columns > 1 else 0
        for i in range(samples):
            if i > 0:
                step = u[i, column] - u[i - 1, column]
                r = _excess(stiction[j], step / (time[i] - time[i - 1]), slowest[j]) if timed else 1.0
                end = math.copysign(r, step)
                z[i, j] = end + (z[i - 1, j] - end) * math.exp(-abs(step) / (r * distance[j]))
            if timed and samples > 1:
                first = max(i - 1, 0)
                last = min(i + 1, samples - 1)
                now = (u[last, column] - u[first, column]) / (time[last] - time[first])
                v[i, j] = now
                bending[i, j] = now - abs(now) * z[i, j] / _excess(stiction[j], now, slowest[j])
    return z, bending, v

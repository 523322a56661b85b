"""An even nonlinearity of the input of a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def bend(u: Array, curvature: Array) -> Array:
    """u + curvature u^2.

    u : float64[samples, 1] or float64[samples, swarm]    any unit
    curvature : float64[swarm]                            1 / unit of u; 0: u to the last bit
    -> float64[samples, swarm]                            unit of u
    """
    samples, columns = u.shape
    swarm = curvature.size
    bent = np.empty((samples, swarm))
    for i in range(samples):
        for j in range(swarm):
            x = u[i, j] if columns > 1 else u[i, 0]
            bent[i, j] = curvature[j] * (x * x) + x
    return bent

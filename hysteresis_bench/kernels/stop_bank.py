"""A bank of stop operators with clearance: springs that slip, side by side, for a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.play import centred, played


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def stop_bank(u: Array, slope: Array, limits: Array, stiffnesses: Array, gap: Array) -> Array:
    """slope u + sum of stiffnesses[k] times how far element k is strained, at most limits[k] to either side.

    Between its strains of either sign every element crosses a clearance of 2 gap without force: it is a spring that
    slips at limits[k], in series with a play of half-width gap. Rate-independent, exact for an input that is monotone
    between its samples. All elements start unstrained, in the middle of their clearance.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    slope, gap : float64[swarm]                           output over u, any sign; unit of u, >= 0
    limits, stiffnesses : float64[elements, swarm]        unit of u, >= 0; output over u, any sign
    -> float64[samples, swarm]                            unit of the output

    [1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2: u = stop + play.
    """
    samples, columns = u.shape
    elements, swarm = stiffnesses.shape
    position = centred(u, elements, swarm)
    force = np.empty((samples, swarm))
    for i in range(samples):
        for j in range(swarm):
            force[i, j] = slope[j] * (u[i, j] if columns > 1 else u[i, 0])
        for k in range(elements):
            for j in range(swarm):
                now = u[i, j] if columns > 1 else u[i, 0]
                position[k, j] = played(now, limits[k, j] + gap[j], position[k, j])
                e = now - position[k, j]
                force[i, j] += stiffnesses[k, j] * (max(e - gap[j], 0.0) + min(e + gap[j], 0.0))
    return force

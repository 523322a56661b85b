"""Populations of switching domains of a swarm: hyperbolic tangents of play operators."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.elementary import exponential
from hysteresis_bench.kernels.play import centred, played


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def play_tanh(u: Array, heights: Array, radii: Array, centres: Array, widths: Array) -> Array:
    """sum over populations k of heights[k] tanh((P_k - centres[k]) / widths[k]), P_k the play of half-width radii[k].

    Rate-independent, exact for an input that is monotone between its samples. Every play starts in the middle of its
    dead band.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    heights : float64[populations, swarm]                 unit of the output
    radii, centres, widths : float64[populations, swarm]  unit of u; radii >= 0, widths > 0
    -> float64[samples, swarm]                            unit of the output
    """
    samples, columns = u.shape
    populations, swarm = heights.shape
    state = centred(u, populations, swarm)
    y = np.zeros((samples, swarm))
    for i in range(samples):
        for k in range(populations):
            for j in range(swarm):
                now = u[i, j] if columns > 1 else u[i, 0]
                state[k, j] = played(now, radii[k, j], state[k, j])
                x = (state[k, j] - centres[k, j]) / widths[k, j]
                falling = exponential(-2.0 * abs(x))
                tanh = (1.0 - falling) / (1.0 + falling)
                y[i, j] += heights[k, j] * (tanh if x >= 0.0 else -tanh)
    return y

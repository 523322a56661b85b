"""A bank of play operators whose positions enter by curves of straight pieces, for a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.play import played


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def play_hats(u: Array, radii: Array, nodes: Array, weights: Array) -> Array:
    """sum over plays k of phi_k(P_k), phi_k straight between nodes, rising by weights[k, j] from node j to j + 1.

    The slope of phi_k is a sum of steps, a Preisach density of steps where there are many plays. Before the first node
    phi_k is 0, past the last it stays. Rate-independent, exact for an input that is monotone between its samples. Every
    play starts in the middle of its dead band.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    radii : float64[plays, swarm]                         half-widths, unit of u, >= 0
    nodes : float64[pieces + 1, swarm]                    rising, unit of u
    weights : float64[plays, pieces, swarm]               unit of the output
    -> float64[samples, swarm]                            unit of the output
    """
    samples, columns = u.shape
    plays, pieces, swarm = weights.shape
    y = np.zeros((samples, swarm))
    below = np.empty(pieces + 1)
    for j in range(swarm):
        column = j if columns > 1 else 0
        edges = nodes[:, j].copy()
        for k in range(plays):
            below[0] = 0.0
            flat = True
            for piece in range(pieces):
                below[piece + 1] = below[piece] + weights[k, piece, j]
                flat = flat and weights[k, piece, j] == 0.0
            if flat:  # as all curves but one are where a fit asks for its columns
                continue
            radius = radii[k, j]
            place = u[0, column]
            piece = 0
            for i in range(samples):
                place = played(u[i, column], radius, place)
                while piece < pieces - 1 and place > edges[piece + 1]:
                    piece += 1
                while piece > 0 and place < edges[piece]:
                    piece -= 1
                share = (place - edges[piece]) / (edges[piece + 1] - edges[piece])
                share = min(max(share, 0.0), 1.0)
                y[i, j] += below[piece] + share * (below[piece + 1] - below[piece])
    return y

"""A bank of play operators whose positions enter by curves of straight pieces, for a swarm."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.lanes import LANES
from hysteresis_bench.kernels.play import played


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _followed(u: Array, radius: float, edges: Array, pieces: Array, shares: Array) -> None:
    """The way of a play: the piece of the curve where it is, and how far along that, at every sample."""
    last, place, piece = edges.size - 2, u[0], 0
    for i in range(u.size):
        place = played(u[i], radius, place)
        while piece < last and place > edges[piece + 1]:
            piece += 1
        while piece > 0 and place < edges[piece]:
            piece -= 1
        share = (place - edges[piece]) / (edges[piece + 1] - edges[piece])
        pieces[i] = piece
        shares[i] = min(max(share, 0.0), 1.0)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _risen(pieces: Array, shares: Array, weights: Array, below: Array, rises: Array, y: Array) -> None:
    """Adds the curve of these weights along a way to y; below, rises : (pieces,), overwritten"""
    value = 0.0
    for piece in range(weights.size):
        below[piece] = value
        value += weights[piece]
        rises[piece] = value - below[piece]
    for i in range(pieces.size):
        y[i] += below[pieces[i]] + shares[i] * rises[pieces[i]]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def play_hats(u: Array, radii: Array, nodes: Array, weights: Array, slope: Array) -> Array:
    """slope u + sum over plays k of phi_k(P_k), phi_k straight, rising by weights[k, j] from node j to j + 1.

    The slope of phi_k is a sum of steps, a Preisach density of steps where there are many plays. Before the first node
    phi_k is 0, past the last it stays. Rate-independent, exact for an input that is monotone between its samples. Every
    play starts in the middle of its dead band.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    radii : float64[plays, swarm]                         half-widths, unit of u, >= 0
    nodes : float64[pieces + 1, swarm]                    rising, unit of u
    weights : float64[plays, pieces, swarm]               unit of the output
    slope : float64[swarm]                                unit of the output over that of u
    -> float64[samples, swarm]                            unit of the output
    """
    samples, columns = u.shape
    plays, count, swarm = weights.shape
    y = np.empty((samples, swarm))
    used = np.zeros((plays, swarm), dtype=np.bool_)
    for k in range(plays):
        for piece in range(count):
            for j in range(swarm):
                used[k, j] |= weights[k, piece, j] != 0.0
    sums, below, rises = np.empty((LANES, samples)), np.empty(count), np.empty(count)
    pieces, shares = np.empty(samples, dtype=np.int64), np.empty(samples)
    radius, edges, way = np.nan, nodes[:, 0].copy(), u[:, 0].copy()
    for first in range(0, swarm, LANES):  # so many that a line of y in the cache is written once
        lanes = min(LANES, swarm - first)
        for lane in range(lanes):
            j = first + lane
            if columns > 1 or (edges != nodes[:, j]).any():
                radius, edges, way = np.nan, nodes[:, j].copy(), u[:, j if columns > 1 else 0].copy()
            for i in range(samples):
                sums[lane, i] = slope[j] * way[i]
            for k in range(plays):
                if used[k, j]:  # as is one curve alone where a fit asks for its columns, and many have its play
                    if radii[k, j] != radius:
                        radius = radii[k, j]
                        _followed(way, radius, edges, pieces, shares)
                    _risen(pieces, shares, weights[k, :, j], below, rises, sums[lane])
        for i in range(samples):
            for lane in range(lanes):
                y[i, first + lane] = sums[lane, i]
    return y

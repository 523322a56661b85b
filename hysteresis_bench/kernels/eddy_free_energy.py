"""Homogenized free-energy magnetization with eddy currents: `free_energy` and `eddy_current` say what each is."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.eddy_current import COEFFICIENT, NEW, simulated
from hysteresis_bench.kernels.free_energy import LANES as NODES
from hysteresis_bench.kernels.free_energy import error_function, moving, radii
from hysteresis_bench.kernels.lanes import LANES, LAW, OPEN, OUT, TRIAL, Y, Z
from hysteresis_bench.kernels.play import played

# Rows of the nodes' work array: the plays' P and their share of the magnetization, each with what the last trial found.
RADIUS, WEIGHT, STATE, TERM, NEXT_STATE, NEXT_TERM = range(6)
# Rows of a group of particles; MOVED: how many nodes the last trial moved.
SCALE, SLOPE, AMPLITUDE, MOVED = ((LAW + row) * LANES for row in range(4))
WIDTH = (LAW + 4) * LANES


@njit(cache=True, error_model="numpy", fastmath={"contract", "reassoc"})
def _switched(nodes: Array, h: float) -> tuple[int, float]:
    """How many nodes of one particle, those of smallest radius, the scaled field h moves, and the sum of all terms."""
    moved = moving(h, nodes[STATE], nodes[RADIUS])
    total = 0.0
    for j in range(moved):
        p = played(h, nodes[RADIUS, j], nodes[STATE, j])
        nodes[NEXT_STATE, j] = p
        nodes[NEXT_TERM, j] = nodes[WEIGHT, j] * error_function(p)
        total += nodes[NEXT_TERM, j]
    for j in range(moved, nodes.shape[1]):
        total += nodes[TERM, j]
    return moved, total


@njit(cache=True, error_model="numpy")
def _advanced(nodes: Array, work: Array, left: Array) -> None:
    """M where the acting field has moved on to the trial; particles one by one, as their nodes go side by side."""
    s = work[0]
    for j in range(LANES if left[0] > 0 else 0):
        if s[OPEN + j] > 0.0:
            z = s[TRIAL + j]
            s[MOVED + j], total = _switched(nodes[j], s[SCALE + j] * z)
            s[OUT + j] = s[SLOPE + j] * z + s[AMPLITUDE + j] * total


@njit(cache=True, error_model="numpy")
def _kept(nodes: Array, work: Array) -> None:
    """What the last trial found is the state."""
    s = work[0]
    for j in range(LANES):
        for k in range(int(s[MOVED + j])):
            nodes[j, STATE, k] = nodes[j, NEXT_STATE, k]
            nodes[j, TERM, k] = nodes[j, NEXT_TERM, k]


@njit(cache=True, error_model="numpy")
def eddy_magnetization(
    time: Array,
    field: Array,
    coefficient: Array,
    slope: Array,
    amplitude: Array,
    coercive_field: Array,
    spread: Array,
    interaction: Array,
    offsets: Array,
    weights: Array,
) -> Array:
    """M of a swarm, where z = H - coefficient dM/dt acts in place of the field H.

    time : float64[samples]           strictly increasing
    coefficient : float64[swarm]      >= 0, unit of H times unit of time over unit of M
    the others, and the result, as in `magnetization`
    -> float64[samples, swarm]        C order; z = H at the first sample, which switches the demagnetized plays
    """
    samples, swarm = field.shape[0], slope.size
    nodes = np.zeros((LANES, 6, -(-offsets.size // NODES) * NODES))
    magnetized = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        nodes[:] = 0.0
        work = np.zeros((1, WIDTH))
        s = work[0]
        for j in range(LANES):
            p = min(first + j, swarm - 1)
            s[COEFFICIENT + j] = coefficient[p]
            s[SCALE + j] = 1.0 / (interaction[p] * math.sqrt(2.0))
            s[SLOPE + j] = slope[p]
            s[AMPLITUDE + j] = amplitude[p]
            for node in range(offsets.size):
                nodes[j, WEIGHT, node] = weights[node]
            radii(s[SCALE + j], coercive_field[p], spread[p], offsets, nodes[j, RADIUS])
            s[NEW + j] = s[TRIAL + j] = s[Z + j] = field[0, p if field.shape[1] > 1 else 0]
            s[OPEN + j] = 1.0
        _advanced(nodes, work, np.ones(1, dtype=np.int64))
        _kept(nodes, work)
        for j in range(LANES):
            s[Y + j] = s[OUT + j]
            magnetized[0, min(first + j, swarm - 1)] = s[Y + j]
        simulated(_advanced, _kept, nodes, work, time, field, first, magnetized)
    return magnetized

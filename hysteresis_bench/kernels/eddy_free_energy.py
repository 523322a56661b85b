"""Homogenized free-energy magnetization with eddy currents: `free_energy` and `eddy_current` say what each is."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.eddy_current import acting
from hysteresis_bench.kernels.free_energy import LANES, error_function, moving, played, radii

# Rows of the nodes' work array: the plays' P and their share of the magnetization, each with what the last trial found.
RADIUS, WEIGHT, STATE, TERM, NEXT_STATE, NEXT_TERM = range(6)
SCALE, SLOPE, AMPLITUDE, MOVED = range(4)


@njit(cache=True, error_model="numpy", fastmath={"contract", "reassoc"})
def _advanced(of: tuple[Array, Array], z: float) -> float:
    """M where the acting field has moved on to z; the MOVED nodes of smallest radius find NEXT_STATE, NEXT_TERM."""
    nodes, s = of
    h = s[SCALE] * z
    moved = moving(h, nodes[STATE], nodes[RADIUS])
    total = 0.0
    for j in range(moved):
        p = played(h, nodes[RADIUS, j], nodes[STATE, j])
        nodes[NEXT_STATE, j] = p
        nodes[NEXT_TERM, j] = nodes[WEIGHT, j] * error_function(p)
        total += nodes[NEXT_TERM, j]
    for j in range(moved, nodes.shape[1]):
        total += nodes[TERM, j]
    s[MOVED] = moved
    return s[SLOPE] * z + s[AMPLITUDE] * total


@njit(cache=True, error_model="numpy")
def _kept(nodes: Array, s: Array) -> None:
    """What the last trial found is the state."""
    for j in range(int(s[MOVED])):
        nodes[STATE, j] = nodes[NEXT_STATE, j]
        nodes[TERM, j] = nodes[NEXT_TERM, j]


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
    padded = -(-offsets.size // LANES) * LANES
    nodes = np.zeros((6, padded))
    s = np.zeros(4)
    nodes[WEIGHT, : offsets.size] = weights
    magnetized = np.empty((samples, swarm))
    for i in range(swarm):
        column = i if field.shape[1] > 1 else 0
        s[SCALE] = 1.0 / (interaction[i] * math.sqrt(2.0))
        s[SLOPE] = slope[i]
        s[AMPLITUDE] = amplitude[i]
        radii(s[SCALE], coercive_field[i], spread[i], offsets, nodes[RADIUS])
        nodes[STATE] = 0.0
        nodes[TERM] = 0.0
        z = field[0, column]
        magnetized[0, i] = _advanced((nodes, s), z)
        _kept(nodes, s)
        for k in range(1, samples):
            rate = coefficient[i] / (time[k] - time[k - 1])
            z, magnetized[k, i] = acting(
                _advanced, (nodes, s), z, magnetized[k - 1, i], field[k - 1, column], field[k, column], rate
            )
            _kept(nodes, s)
    return magnetized

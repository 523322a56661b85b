"""A lag that is a curve of the rate, of a swarm: exact for a signal that is linear between its samples.

What follows a signal u is behind it by d = u - v, and moves at the rate dv/dt = r at which d = g(r): g rises through
the origin in straight pieces, with one slope (a time constant) up to a rate of R and another one beyond, for movement
upwards and downwards each. Over a step of duration h on which u changes by s h,

    dd/dt = s - g⁻¹(d),

so that d goes monotonically towards g(s) and passes from piece to piece on the way; within a piece of slope tau whose
line leads to d_s at the rate s, with x = h / tau,

    d  ->  exp(-x) d  +  d_s (1 - exp(-x)).

With all slopes equal it is the first-order lag of `lag`, with all of them 0 the signal itself, to the last bit.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.linear_stage import SAME_STEP

PIECES = 4
"""Fast and slow movement downwards, slow and fast movement upwards: the order of d."""

LEAST = 1e-9
"""Of the step, the shortest time constant: beside pieces that lag, one of less counts as this and leaves no trace."""


@njit(cache=True, error_model="numpy")
def _pieces(step: float, knot: float, constants: Array, lines: Array) -> None:
    """Of one column and step: time constants, exp(-x), 1 - exp(-x), and where each piece ends, into lines (4, 4)."""
    for k in range(PIECES):
        tau = max(constants[k], LEAST * step)
        x = step / tau
        lines[0, k] = tau
        lines[1, k] = math.exp(-x)
        lines[2, k] = -math.expm1(-x)
    lines[3, 0] = -lines[0, 1] * knot
    lines[3, 1] = 0.0
    lines[3, 2] = lines[0, 2] * knot


@njit(cache=True, error_model="numpy")
def _moved(d: float, s: float, step: float, knot: float, lines: Array) -> float:
    """The distance behind after a step on which the signal changes at the rate s."""
    if s >= 0.0:
        goal = lines[0, 2] * min(s, knot) + lines[0, 3] * max(s - knot, 0.0)
    else:
        goal = -lines[0, 1] * min(-s, knot) - lines[0, 0] * max(-s - knot, 0.0)
    upwards = goal > d
    piece = 0
    for k in range(PIECES - 1):
        if lines[3, k] < d or (upwards and lines[3, k] == d):
            piece = k + 1
    left = step
    while True:
        tau = lines[0, piece]
        if piece == 0:
            line = lines[3, 0] + tau * (s + knot)
        elif piece == PIECES - 1:
            line = lines[3, 2] + tau * (s - knot)
        else:
            line = tau * s
        if left == step:
            after = lines[1, piece] * d + lines[2, piece] * line
        else:
            after = d + math.expm1(-left / tau) * (d - line)
        if upwards and piece < PIECES - 1 and after > lines[3, piece]:
            end, further = lines[3, piece], 1
        elif not upwards and piece > 0 and after < lines[3, piece - 1]:
            end, further = lines[3, piece - 1], -1
        else:
            return after
        left -= tau * math.log1p((d - end) / (end - line))
        d = end
        piece += further
        if left <= 0.0:
            return d


@njit(cache=True, error_model="numpy")
def lag_curve(time: Array, u: Array, knot: Array, constants: Array) -> Array:
    """What follows every column behind by a curve of its rate; in equilibrium with the first sample, v = u.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    linear between its samples
    knot : float64[swarm]                                 R > 0, unit of u over unit of time
    constants : float64[4, swarm]                         >= 0, unit of time: downwards beyond R, downwards up to R,
                                                          upwards up to R, upwards beyond R; all 0: v = u
    -> float64[samples, swarm]                            v, unit of u, within the range of u
    """
    samples, columns, swarm = u.shape[0], u.shape[1], knot.size
    v = np.empty((samples, swarm))
    lines = np.empty((PIECES, PIECES))
    for j in range(swarm):
        column = j if columns > 1 else 0
        own = constants[:, j].copy()
        lags = np.any(own > 0.0)
        behind, known = 0.0, 0.0
        v[0, j] = u[0, column]
        for i in range(1, samples):
            if not lags:
                v[i, j] = u[i, column]
                continue
            step = time[i] - time[i - 1]
            if abs(step - known) > SAME_STEP * known:
                _pieces(step, knot[j], own, lines)
                known = step
            behind = _moved(behind, (u[i, column] - u[i - 1, column]) / step, step, knot[j], lines)
            v[i, j] = u[i, column] - behind
    return v

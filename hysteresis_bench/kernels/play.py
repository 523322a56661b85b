"""The play operator of a swarm: what a gear with a clearance does to a motion."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(inline="always", error_model="numpy")
def played(u, radius, p):  # type: ignore[no-untyped-def]
    """Where an input u takes a play that is at p."""
    high = u + radius
    low = u - radius
    p = high if high < p else p
    return low if low > p else p


@njit(cache=True, error_model="numpy")
def centred(u: Array, plays: int, swarm: int) -> Array:
    """Plays that begin in the middle of their dead bands: float64[plays, swarm], the first input; u as in `play`."""
    state = np.empty((plays, swarm))
    for k in range(plays):
        for j in range(swarm):
            state[k, j] = u[0, j if u.shape[1] > 1 else 0]
    return state


@njit(cache=True, error_model="numpy")
def play(u: Array, radius: Array) -> Array:
    """Play (backlash) operator: the output follows the input with a dead band.

    Rate-independent: the order of samples matters, their times do not. Exact for an input that is monotone
    between its samples. A bank of plays on one input is a swarm of radii.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    radius : float64[swarm]                               half-width of the dead band, unit of u, >= 0;
                                                          0: the input itself, to the last bit
    -> float64[samples, swarm]                            unit of u

    [1]  p_i = max(u_i - r, min(u_i + r, p_{i-1}))
    Ours: starts at p_0 = u_0, in the middle of the dead band.
    [1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
    """
    samples, columns = u.shape
    swarm = radius.size
    p = np.empty((samples, swarm))
    for j in range(swarm):
        p[0, j] = u[0, j if columns > 1 else 0]
    if columns > 1:
        for i in range(1, samples):
            now, before, after = u[i], p[i - 1], p[i]
            for j in range(swarm):
                after[j] = played(now[j], radius[j], before[j])
        return p
    for i in range(1, samples):
        now, before, after = u[i, 0], p[i - 1], p[i]
        for j in range(swarm):
            after[j] = played(now, radius[j], before[j])
    return p

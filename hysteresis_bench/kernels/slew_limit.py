"""A limit on how fast a signal is followed, of a swarm: exact for a signal that is linear between its samples.

What follows a signal u moves up at the rate `up` at most and down at `down`, and as fast as it can until it has caught
up; then it goes with the signal, as long as that is no faster. Over a step it may catch up on the way, and then fall
behind on the other side.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(inline="always", error_model="numpy")
def followed(step, before, now, v, up, down):  # type: ignore[no-untyped-def]
    """Where what follows is after a step, from v.  before, now : the signal at the step's ends;  up, down : > 0"""
    slope = (now - before) / step
    left = step
    if v != before:
        rate = up if v < before else -down
        away, closing = before - v, rate - slope
        if away * closing <= 0.0 or abs(away) >= abs(closing) * step:
            return v + rate * step
        left = step - away / closing
    if slope > up:
        return now - (slope - up) * left
    if slope < -down:
        return now - (slope + down) * left
    return now


@njit(cache=True, error_model="numpy")
def slew_limited(time: Array, u: Array, rising: Array, falling: Array) -> Array:
    """What follows a signal no faster than its least times per unit of way allow, from the first sample on.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    input, linear between its samples
    rising, falling : float64[swarm]                      least time per unit of u upwards, downwards, >= 0; unit of
                                                          time over unit of u; both 0: u to the last bit
    -> float64[samples, swarm]                            unit of u, within the range of u
    """
    samples, columns, swarm = u.shape[0], u.shape[1], rising.size
    v = np.empty((samples, swarm))
    for j in range(swarm):
        column, up, down = j if columns > 1 else 0, 1.0 / rising[j], 1.0 / falling[j]
        v[0, j] = u[0, column]
        for i in range(1, samples):
            step = time[i] - time[i - 1]
            v[i, j] = followed(step, u[i - 1, column], u[i, column], v[i - 1, j], up, down)
    return v

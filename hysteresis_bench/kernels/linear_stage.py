"""The march of a linear stage along a time grid, which the lags and the second-order stage share.

A stage that rests in static equilibrium with the first sample is followed by its deviation from the static response,
v - u. Over a step on which u is linear the deviation changes by coefficients that depend on the step's duration alone,
so that an even grid costs one set of them.
"""

from __future__ import annotations

from numba import njit

SAME_STEP = 1e-9
"""Steps of the time grid that differ by less than this share count as equal."""


# Inlined, with what it is given: a kernel that passed functions to a function of its own could not be cached.
@njit(inline="always", error_model="numpy")
def followed(prepared, advanced, stage, time, u, v):  # type: ignore[no-untyped-def]
    """v, float64[samples, swarm], of stages that rest with the first sample of u, shared or one a particle.

    prepared(stage, duration) : computes the coefficients of a step
    advanced(stage, i, duration, u, v) : one sample on, state and v[i]
    stage : tuple of arrays, parameters, coefficients and state, which only those two know
    """
    for j in range(v.shape[1]):
        v[0, j] = u[0, j if u.shape[1] > 1 else 0]
    known = 0.0
    for i in range(1, v.shape[0]):
        duration = time[i] - time[i - 1]
        if abs(duration - known) > SAME_STEP * known:
            known = duration
            prepared(stage, duration)
        advanced(stage, i, duration, u, v)

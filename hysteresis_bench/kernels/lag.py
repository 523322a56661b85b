"""First-order lags of a swarm, exact for a signal that is linear between its samples, on any time grid.

A lag tau dv/dt + v = u that starts in static equilibrium, v = u at the first sample, is followed by its
deviation e = v - u. Over a step of duration h on which u changes by du, with x = h / tau,

    e  ->  exp(-x) e  -  du (1 - exp(-x)) / x.

tau = 0 gives exp(-x) = 0 and a deviation of exactly 0, so that v = u to the last bit.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.linear_stage import SAME_STEP, followed


@njit(cache=True, error_model="numpy")
def _decays(step: float, time_constant: Array, kept: Array, passed: Array) -> None:
    """exp(-x) and (1 - exp(-x)) / x of every column, x = step / time constant."""
    for j in range(time_constant.size):
        if time_constant[j] > 0.0:
            x = step / time_constant[j]
            kept[j] = math.exp(-x)
            passed[j] = -math.expm1(-x) / x if x > 0.0 else 1.0  # a lag so slow that x underflows
        else:
            kept[j] = 0.0
            passed[j] = 0.0


@njit(inline="always", error_model="numpy")
def _lag_prepared(stage, duration):  # type: ignore[no-untyped-def]
    time_constant, kept, passed, _ = stage
    _decays(duration, time_constant, kept, passed)


@njit(inline="always", error_model="numpy")
def _lag_advanced(stage, i, duration, u, v):  # type: ignore[no-untyped-def]
    _, kept, passed, deviation = stage
    columns = u.shape[1]
    for j in range(kept.size):
        now = u[i, j] if columns > 1 else u[i, 0]
        before = u[i - 1, j] if columns > 1 else u[i - 1, 0]
        deviation[j] = kept[j] * deviation[j] - passed[j] * (now - before)
        v[i, j] = now + deviation[j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def lag(time: Array, u: Array, time_constant: Array) -> Array:
    """First-order lag of every column, tau dv/dt + v = u, in static equilibrium with the first sample.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    input, linear between its samples
    time_constant : float64[swarm]                        tau >= 0, unit of time; 0: v = u to the last bit
    -> float64[samples, swarm]                            v, unit of u, within the range of u
    """
    swarm = time_constant.size
    v = np.empty((u.shape[0], swarm))
    stage = (time_constant, np.empty(swarm), np.empty(swarm), np.zeros(swarm))
    followed(_lag_prepared, _lag_advanced, stage, time, u, v)
    return v


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def late_response(time: Array, u: Array, share: Array, time_constants: Array) -> Array:
    """A share of the signal arrives late, through equally weighted lags: u + share mean_k(lag_k(u) - u).

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    linear between its samples
    share : float64[swarm]                                0: the signal itself, to the last bit
    time_constants : float64[lags, swarm]                 >= 0, unit of time
    -> float64[samples, swarm]                            unit of u; equal to u at the first sample and in rest

    Marches along the time grid by itself: by `followed` a swarm of 50 takes 1.2 times as long, a swarm of one 1.9.
    """
    samples, columns = u.shape
    lags, swarm = time_constants.shape
    v = np.empty((samples, swarm))
    kept = np.empty((lags, swarm))
    passed = np.empty((lags, swarm))
    deviation = np.zeros((lags, swarm))
    total = np.empty(swarm)
    weight = share / lags
    known = 0.0
    for j in range(swarm):
        v[0, j] = u[0, j if columns > 1 else 0]
    for i in range(1, samples):
        step = time[i] - time[i - 1]
        if abs(step - known) > SAME_STEP * known:
            known = step
            for k in range(lags):
                _decays(step, time_constants[k], kept[k], passed[k])
        total[:] = 0.0
        for k in range(lags):
            for j in range(swarm):
                change = u[i, j] - u[i - 1, j] if columns > 1 else u[i, 0] - u[i - 1, 0]
                deviation[k, j] = kept[k, j] * deviation[k, j] - passed[k, j] * change
                total[j] += deviation[k, j]
        for j in range(swarm):
            v[i, j] = u[i, j if columns > 1 else 0] + weight[j] * total[j]
    return v


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def weighted_lags(time: Array, u: Array, weights: Array, time_constants: Array) -> Array:
    """Parts of the signal arrive late, through lags of weights of their own: u + sum_k weight_k (lag_k(u) - u).

    The arguments as in `late_response`; weights : float64[lags, swarm], of either sign; all 0: u to the last bit
    """
    samples, columns = u.shape
    lags, swarm = time_constants.shape
    v = np.empty((samples, swarm))
    kept = np.empty((lags, swarm))
    passed = np.empty((lags, swarm))
    deviation = np.zeros((lags, swarm))
    known = 0.0
    for j in range(swarm):
        v[0, j] = u[0, j if columns > 1 else 0]
    for i in range(1, samples):
        step = time[i] - time[i - 1]
        if abs(step - known) > SAME_STEP * known:
            known = step
            for k in range(lags):
                _decays(step, time_constants[k], kept[k], passed[k])
        for j in range(swarm):
            v[i, j] = u[i, j] if columns > 1 else u[i, 0]
        for k in range(lags):
            for j in range(swarm):
                change = u[i, j] - u[i - 1, j] if columns > 1 else u[i, 0] - u[i - 1, 0]
                deviation[k, j] = kept[k, j] * deviation[k, j] - passed[k, j] * change
                v[i, j] += weights[k, j] * deviation[k, j]
    return v

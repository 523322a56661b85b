"""First-order lags of a swarm, exact for a signal that is linear between its samples, on any time grid.

A lag tau dv/dt + v = u that starts in static equilibrium, v = u at the first sample, is followed by its
deviation e = v - u. Over a step of duration h on which u changes by du, with x = h / tau,

    e  ->  exp(-x) e  -  du (1 - exp(-x)) / x.

tau = 0 gives exp(-x) = 0 and a deviation of exactly 0, so that v = u to the last bit.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import FEW, FULL, LANES, series
from hysteresis_bench.kernels.elementary import exponential
from hysteresis_bench.kernels.linear_stage import SAME_STEP

# Rows of one work array, the last four for every lag; unsigned, as in `bouc_wen`. Four samples from NOW on.
BEFORE, NOW = (np.uint64(row * LANES) for row in range(2))
KEPT, PASSED, DEVIATION, WEIGHT = (np.uint64(row * LANES) for row in range(5, 9))
ROW, TWO = np.uint64(LANES), np.uint64(2 * LANES)


SHORT = 0.125
"""Steps over a time constant below which the series is to the last digit."""


def _read(u: Array) -> Array:
    """The same numbers, only to be read: what is measured and what is computed have one kernel, not one each."""
    view = u.view()
    view.flags.writeable = False
    return view


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
def _decays_again(step, time_constant, kept, passed):  # type: ignore[no-untyped-def]
    """As `_decays` to 5e-15, side by side: for an uneven grid, where every step asks for them.

    time_constant, kept, passed : padded to a multiple of FULL
    """
    for j in range(time_constant.size // FULL * FULL):
        lags = time_constant[j] > 0.0
        x = step / time_constant[j]
        decay = exponential(-x)
        near = series(min(x, SHORT))
        kept[j] = decay if lags else 0.0
        passed[j] = (near if x < SHORT else (1.0 - decay) / x) if lags else 0.0


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _lag(time: Array, u: Array, time_constant: Array) -> Any:
    samples, columns, swarm = u.shape[0], u.shape[1], time_constant.size
    v = np.empty((samples, swarm))
    constants = np.zeros(-(-swarm // FULL) * FULL)
    for j in range(swarm):
        constants[j] = time_constant[j]
    kept, passed, deviation = np.empty(constants.size), np.empty(constants.size), np.zeros(swarm)
    for j in range(swarm):
        v[0, j] = u[0, j if columns > 1 else 0]
    known = 0.0
    for i in range(1, samples):
        step = time[i] - time[i - 1]
        if abs(step - known) > SAME_STEP * known:
            if known == 0.0:
                _decays(step, constants, kept, passed)
            else:
                _decays_again(step, constants, kept, passed)
            known = step
        if columns > 1:
            for j in range(swarm):
                deviation[j] = kept[j] * deviation[j] - passed[j] * (u[i, j] - u[i - 1, j])
                v[i, j] = u[i, j] + deviation[j]
        else:
            for j in range(swarm):
                deviation[j] = kept[j] * deviation[j] - passed[j] * (u[i, 0] - u[i - 1, 0])
                v[i, j] = u[i, 0] + deviation[j]
    return v


def lag(time: Array, u: Array, time_constant: Array) -> Array:
    """First-order lag of every column, tau dv/dt + v = u, in static equilibrium with the first sample.

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    input, linear between its samples
    time_constant : float64[swarm]                        tau >= 0, unit of time; 0: v = u to the last bit
    -> float64[samples, swarm]                            v, unit of u, within the range of u
    """
    behind: Array = _lag(_read(time), _read(u), time_constant)
    return behind


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _late(work, weights, lanes, lags):  # type: ignore[no-untyped-def]
    """One sample of all lags.  weights : has every lag its own? else the sum has one"""
    for j in range(lanes):
        now = work[NOW + j]
        change = now - work[BEFORE + j]
        total = now if weights else 0.0
        for k in range(lags):
            lag = np.uint64(k * 4 * LANES) + j
            late = work[KEPT + lag] * work[DEVIATION + lag] - work[PASSED + lag] * change
            work[DEVIATION + lag] = late
            total += work[WEIGHT + lag] * late if weights else late
        work[BEFORE + j] = now
        work[NOW + j] = total if weights else now + work[WEIGHT + j] * total


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _four_late(work, weights, lanes, lags):  # type: ignore[no-untyped-def]
    """Four samples as in `_late`: what a lag knows is read and written once."""
    for j in range(lanes):
        before, first, second = work[BEFORE + j], work[NOW + j], work[NOW + ROW + j]
        third, fourth = work[NOW + TWO + j], work[NOW + TWO + ROW + j]
        to_first, to_second, to_third, to_fourth = first - before, second - first, third - second, fourth - third
        a, b, c, d = (first, second, third, fourth) if weights else (0.0, 0.0, 0.0, 0.0)
        for k in range(lags):
            lag = np.uint64(k * 4 * LANES) + j
            kept, passed, weight = work[KEPT + lag], work[PASSED + lag], work[WEIGHT + lag] if weights else 1.0
            late = kept * work[DEVIATION + lag] - passed * to_first
            a += weight * late if weights else late
            late = kept * late - passed * to_second
            b += weight * late if weights else late
            late = kept * late - passed * to_third
            c += weight * late if weights else late
            late = kept * late - passed * to_fourth
            d += weight * late if weights else late
            work[DEVIATION + lag] = late
        work[BEFORE + j] = fourth
        share = work[WEIGHT + j]
        work[NOW + j] = a if weights else first + share * a
        work[NOW + ROW + j] = b if weights else second + share * b
        work[NOW + TWO + j] = c if weights else third + share * c
        work[NOW + TWO + ROW + j] = d if weights else fourth + share * d


@njit(inline="always", error_model="numpy")
def _lags(time, u, weights, time_constants, v, each, lags):  # type: ignore[no-untyped-def]
    """lags : at least as many as there are; a constant, or no loop is vectorised"""
    samples, swarm = u.shape[0], time_constants.shape[1]
    shared = u.shape[1] < swarm
    inputs, outputs = u.ravel(), v.reshape(samples * swarm)
    for first in range((swarm - 1) // LANES * LANES, -1, -LANES):  # the last ones first, for their padding
        used = min(LANES, swarm - first)
        full = -(-used // FULL) * FULL if used > FEW else used
        rows = np.zeros((4 * lags + 5, LANES))
        work = rows.reshape((4 * lags + 5) * LANES)
        for k in range(weights.shape[0]):
            for j in range(used):
                rows[8 + 4 * k, j] = weights[k, first + j]
        for j in range(first, first + used):
            work[BEFORE + np.uint64(j - first)] = u[0, j if u.shape[1] > 1 else 0]
            v[0, j] = u[0, j if u.shape[1] > 1 else 0]
        constants = np.zeros((time_constants.shape[0], -(-used // FULL) * FULL))
        for k in range(time_constants.shape[0]):
            for j in range(used):
                constants[k, j] = time_constants[k, first + j]
        known = 0.0
        i, even = 1, 1  # the next sample, and up to where steps are known to be equal
        while i < samples:
            even = max(even, i + 1)
            step = time[i] - time[i - 1]
            if abs(step - known) > SAME_STEP * known:
                for k in range(time_constants.shape[0]):
                    if known == 0.0:
                        _decays(step, constants[k], rows[5 + 4 * k], rows[6 + 4 * k])
                    else:
                        _decays_again(step, constants[k], rows[5 + 4 * k], rows[6 + 4 * k])
                known = step
            while even < min(i + 4, samples) and abs(time[even] - time[even - 1] - known) <= SAME_STEP * known:
                even += 1
            together = 4 if even >= i + 4 else 1
            for k in range(together):
                lanes = np.uint64(full if i + k + 1 < samples else used)
                row, place = np.uint64((i + k) * swarm + first), np.uint64(k * LANES) + NOW
                for j in range(lanes):
                    work[place + j] = inputs[i + k] if shared else inputs[row + j]
            lanes = np.uint64(full if i + together < samples else used)
            if together == 4:
                _four_late(work, each, lanes, lags)
            else:
                _late(work, each, lanes, lags)
            for k in range(together):
                lanes = np.uint64(full if i + k + 1 < samples else used)
                row, place = np.uint64((i + k) * swarm + first), np.uint64(k * LANES) + NOW
                for j in range(lanes):
                    outputs[row + j] = work[place + j]
            i += together


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _five(time: Array, u: Array, weights: Array, time_constants: Array, v: Array) -> None:
    _lags(time, u, weights, time_constants, v, False, 5)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _any(time: Array, u: Array, weights: Array, time_constants: Array, v: Array) -> None:
    _lags(time, u, weights, time_constants, v, False, time_constants.shape[0])


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _seven_weighted(time: Array, u: Array, weights: Array, time_constants: Array, v: Array) -> None:
    _lags(time, u, weights, time_constants, v, True, 7)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _any_weighted(time: Array, u: Array, weights: Array, time_constants: Array, v: Array) -> None:
    _lags(time, u, weights, time_constants, v, True, time_constants.shape[0])


def late_response(time: Array, u: Array, share: Array, time_constants: Array, out: Array | None = None) -> Array:
    """A share of the signal arrives late, through equally weighted lags: u + share mean_k(lag_k(u) - u).

    time : float64[samples]                               strictly increasing, any spacing
    u : float64[samples, 1] or float64[samples, swarm]    linear between its samples
    share : float64[swarm]                                0: the signal itself, to the last bit
    time_constants : float64[lags, swarm]                 >= 0, unit of time; fastest for five lags at most
    out : float64[samples, swarm]                         where the result goes, a new array by default; may be u
    -> float64[samples, swarm]                            unit of u; equal to u at the first sample and in rest
    """
    lags, swarm = time_constants.shape
    late = np.empty((time.size, swarm)) if out is None else out
    (_five if lags <= 5 else _any)(time, _read(u), share[None] / lags, time_constants, late)
    return late


def weighted_lags(time: Array, u: Array, weights: Array, time_constants: Array, out: Array | None = None) -> Array:
    """Parts of the signal arrive late, through lags of weights of their own: u + sum_k weight_k (lag_k(u) - u).

    The arguments as in `late_response`; weights : float64[lags, swarm], of either sign; all 0: u to the last bit;
    fastest for seven lags at most
    """
    late = np.empty((time.size, weights.shape[1])) if out is None else out
    (_seven_weighted if len(weights) <= 7 else _any_weighted)(time, _read(u), weights, time_constants, late)
    return late

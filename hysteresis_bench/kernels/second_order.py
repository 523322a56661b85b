"""A second-order stage with unit static gain, y'' + c y' + k y = k u: exact for a piecewise-linear input.

Its state is the deviation from the static response and the velocity, (e, y') with e = y - u. Over a step of
duration t on which u rises at the slope r, with Phi = exp(t [[0, 1], [-k, -c]]),

    e  -> Phi00 e + Phi01 y' - r (S + c I)
    y' -> Phi10 e + Phi11 y' + r (1 - Phi00)

where S'' + c S' + k S = 0, S(0) = 0, S'(0) = 1, Phi01 = S, and I is the integral of S.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import FEW, FULL, LANES
from hysteresis_bench.kernels.linear_stage import SAME_STEP

RUNAWAY = 1e9
"""A deviation is cut at this many times the range of the input: only an unstable stage (c < 0 or k <= 0)
comes near."""

STEEPEST = 200.0
"""An unstable stage grows by at most e^200 a step, so that nothing overflows."""

# Rows of one work array; unsigned, as in `bouc_wen`.
INPUT, DEVIATION, VELOCITY, KEPT, SINE, LOST, FALLEN, SLOWED, LEAD = (np.uint64(row * LANES) for row in range(9))
ROWS = 9


@njit(cache=True, error_model="numpy")
def _grown(exponent: float) -> float:
    return math.exp(min(exponent, STEEPEST))


@njit(cache=True, error_model="numpy")
def transition(damping: float, stiffness: float, duration: float) -> tuple[float, float, float, float, float]:
    """(Phi00, Phi01, Phi10, Phi11, S + c I) of one step; all 0 for an infinite stiffness, which has no lag.

    damping : c, 1/s;  stiffness : k, 1/s²;  duration : s
    """
    if math.isinf(stiffness):
        return 0.0, 0.0, 0.0, 0.0, 0.0
    half = 0.5 * damping
    discriminant = half * half - stiffness
    if discriminant > 0.0:  # overdamped: two decays, the slower one without cancellation
        root = math.sqrt(discriminant)
        slow = _grown(-duration * (stiffness / (half + root) if half > 0.0 else half - root))
        fast = _grown(-duration * (half + root))
        sine = slow * -math.expm1(-2.0 * root * duration) / (2.0 * root)
        cosine = 0.5 * (slow + fast)
    else:
        root = math.sqrt(-discriminant)
        decay = _grown(-duration * half)
        sine = decay * (math.sin(root * duration) / root if root > 0.0 else duration)
        cosine = decay * math.cos(root * duration)
    kept = cosine + half * sine
    integral = (1.0 - kept) / stiffness if stiffness != 0.0 else 0.5 * duration * duration
    return kept, sine, -stiffness * sine, cosine - half * sine, sine + damping * integral


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def modes(step: float, u: Array, frequency: float, dampings: Array) -> Array:
    """Position and velocity of stages of one natural frequency, at rest with the first sample.

    step : sampling interval;  u : float64[samples], linear between its samples, of which the first counts as 0
    frequency : rad per unit of time;  dampings : float64[stages], 1 is critical
    -> float64[samples, 2 stages]    position, and velocity over the frequency, stage by stage; unit of u
    """
    found = np.empty((u.size, 2 * dampings.size))
    for j in range(dampings.size):
        damping = 2.0 * dampings[j] * frequency
        kept, sine, fallen, slowed, lost = transition(damping, frequency * frequency, step)
        deviation = velocity = 0.0
        found[0, 2 * j] = found[0, 2 * j + 1] = 0.0
        for i in range(1, u.size):
            slope = (u[i] - u[i - 1]) / step
            before = deviation
            deviation = kept * before + sine * velocity - lost * slope
            velocity = fallen * before + slowed * velocity + (1.0 - kept) * slope
            found[i, 2 * j] = u[i] - u[0] + deviation
            found[i, 2 * j + 1] = velocity / frequency
    return found


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(work, j, slope):  # type: ignore[no-untyped-def]
    """How far one lane is off its input a sample on."""
    e, v = work[DEVIATION + j], work[VELOCITY + j]
    after = work[KEPT + j] * e + work[SINE + j] * v - work[LOST + j] * slope
    work[VELOCITY + j] = work[FALLEN + j] * e + work[SLOWED + j] * v + (1.0 - work[KEPT + j]) * slope
    work[DEVIATION + j] = after
    return _off(work, j)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _off(work, j):  # type: ignore[no-untyped-def]
    return work[DEVIATION + j] + work[LEAD + j] * work[VELOCITY + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _side_by_side(time, u, damping, stiffness, lead, bound, y, first):  # type: ignore[no-untyped-def]
    """As `leading_second_order`, for the LANES stages from `first` on, into y. bound : of a deviation, may be infinite

    Those that pad them are at rest; they read and write what follows in u and y, but for the last sample.
    """
    samples, swarm = y.shape
    shared, bounded = u.shape[1] == 1, bound < np.inf
    inputs, outputs = u.ravel(), y.reshape(samples * swarm)
    used = min(LANES, swarm - first)
    full = -(-used // FULL) * FULL if used > FEW else used
    work = np.zeros(ROWS * LANES)
    for k in range(first, first + used):
        work[INPUT + np.uint64(k - first)] = y[0, k] = u[0, 0 if shared else k]
        work[LEAD + np.uint64(k - first)] = lead[k]
    known = 0.0
    for i in range(1, samples):
        duration = time[i] - time[i - 1]
        rate = 1.0 / duration
        if abs(duration - known) > SAME_STEP * known:
            known = duration
            for k in range(first, first + used):
                lane = np.uint64(k - first)
                kept, sine, fallen, slowed, lost = transition(damping[k], stiffness[k], duration)
                work[KEPT + lane], work[SINE + lane], work[LOST + lane] = kept, sine, lost
                work[FALLEN + lane], work[SLOWED + lane] = fallen, slowed
        lanes = np.uint64(full if i + 1 < samples else used)
        row = np.uint64(i * swarm + first)
        if shared:
            x = u[i, 0]
            slope = (x - u[i - 1, 0]) * rate
            for j in range(lanes):
                outputs[row + j] = x + _advanced(work, j, slope)
        else:
            for j in range(lanes):
                now = inputs[row + j]
                slope = (now - work[INPUT + j]) * rate
                work[INPUT + j] = now
                outputs[row + j] = now + _advanced(work, j, slope)
        if bounded:
            for j in range(lanes):
                work[DEVIATION + j] = min(max(work[DEVIATION + j], -bound), bound)
                work[VELOCITY + j] = min(max(work[VELOCITY + j], -bound * rate), bound * rate)
                outputs[row + j] = (u[i, 0] if shared else work[INPUT + j]) + _off(work, j)


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def leading_second_order(time: Array, u: Array, damping: Array, stiffness: Array, lead: Array) -> Array:
    """As `second_order`, of stages that are passed on with a part of their velocity: k (1 + lead s) / (s² + c s + k).

    lead : float64[swarm]    s
    """
    stable = np.all((damping >= 0.0) & (stiffness > 0.0))
    bound = np.inf if stable else RUNAWAY * (np.max(u) - np.min(u))
    y = np.empty((u.shape[0], stiffness.size))
    for first in range((stiffness.size - 1) // LANES * LANES, -1, -LANES):  # the last ones first, for their padding
        _side_by_side(time, u, damping, stiffness, lead, bound, y, first)
    return y


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def second_order(time: Array, u: Array, damping: Array, stiffness: Array) -> Array:
    """The response of a swarm of stages, from static equilibrium with the first sample.

    time : float64[samples]             strictly increasing, any spacing, s
    u : float64[samples, 1] or float64[samples, swarm]    input, linear between its samples
    damping : float64[swarm]            c, 1/s
    stiffness : float64[swarm]          k = (natural angular frequency)², 1/s²; infinite: y = u to the last bit
    -> float64[samples, swarm]          y, in the unit of u; finite also for an unstable stage (RUNAWAY)
    """
    y: Array = leading_second_order(time, u, damping, stiffness, np.zeros(stiffness.size))
    return y

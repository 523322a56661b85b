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
from hysteresis_bench.kernels.linear_stage import followed

RUNAWAY = 1e9
"""A deviation is cut at this many times the range of the input: only an unstable stage (c < 0 or k <= 0)
comes near."""

STEEPEST = 200.0
"""An unstable stage grows by at most e^200 a step, so that nothing overflows."""


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


@njit(inline="always", error_model="numpy")
def _prepared(stage, duration):  # type: ignore[no-untyped-def]
    damping, stiffness, _, step, _, _ = stage
    for j in range(stiffness.size):
        step[0, j], step[1, j], step[2, j], step[3, j], step[4, j] = transition(damping[j], stiffness[j], duration)


@njit(inline="always", error_model="numpy")
def _advanced(stage, i, duration, u, y):  # type: ignore[no-untyped-def]
    _, _, bound, step, deviation, velocity = stage
    columns, rate = u.shape[1], 1.0 / duration
    fastest = bound * rate
    for j in range(y.shape[1]):
        now = u[i, j] if columns > 1 else u[i, 0]
        before = u[i - 1, j] if columns > 1 else u[i - 1, 0]
        slope = (now - before) * rate
        e = step[0, j] * deviation[j] + step[1, j] * velocity[j] - step[4, j] * slope
        v = step[2, j] * deviation[j] + step[3, j] * velocity[j] + (1.0 - step[0, j]) * slope
        deviation[j] = min(max(e, -bound), bound)
        velocity[j] = min(max(v, -fastest), fastest)
        y[i, j] = now + deviation[j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def second_order(time: Array, u: Array, damping: Array, stiffness: Array) -> Array:
    """The response of a swarm of stages, from static equilibrium with the first sample.

    time : float64[samples]             strictly increasing, any spacing, s
    u : float64[samples, 1] or float64[samples, swarm]    input, linear between its samples
    damping : float64[swarm]            c, 1/s
    stiffness : float64[swarm]          k = (natural angular frequency)², 1/s²; infinite: y = u to the last bit
    -> float64[samples, swarm]          y, in the unit of u; finite also for an unstable stage (RUNAWAY)
    """
    swarm = stiffness.size
    y = np.empty((u.shape[0], swarm))
    bound = RUNAWAY * (np.max(u) - np.min(u))
    stage = (damping, stiffness, bound, np.empty((5, swarm)), np.zeros(swarm), np.zeros(swarm))
    followed(_prepared, _advanced, stage, time, u, y)
    return y

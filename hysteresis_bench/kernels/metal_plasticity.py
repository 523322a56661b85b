"""Cyclic plasticity of a swarm: `metal_plasticity_step` has the law and the step of one particle.

Here LANES particles make that step side by side. Where p goes on by d in an increment, the stress in excess of what the
metal bears is

    e(d) = e(0) - d - sum over k of c_k (1 - exp(-r_k d)),

k the two backstresses, c = S - s X, and what hardens and softens, c = Q exp(-b p) and c = -D exp(-a p). All that its
derivatives at d = 0 want is known, so that the first guess of d takes no exponential; d is then mended by Householder's
method of third order. What saturates is carried to the new d by a series, which tells the excess that is left there, so
that no step is made to confirm another.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels import metal_plasticity_step as one
from hysteresis_bench.kernels.elementary import TO_BASE_2, power_of_2
from hysteresis_bench.kernels.metal_plasticity_step import CLOSE, MOST_STEPS, STEEPEST

LANES = 16
"""Particles side by side; a swarm is padded to a multiple with copies of its last particle. With 8 a processor waits
for results of its own: 15 ns a particle and sample for 12."""
ROUNDING = 2e-15
"""Excess that is none, of the sum of all stresses that the parameters name: it is told no better."""
WIDEST = 4.0
"""A step is at most this many times Newton's, and no smaller a share of it."""
FARTHEST_BACK = 1.0
"""Of 1 / r_k, how far back the series is trusted, where what saturates grows."""

# Rows of a group: r_k, c_k and what is left of the backstresses', of exp(-b p) and of exp(-a p) at d, then the other
# parameters, the state, the increment, and d with its bounds.
RATE_1, RATE_2, RATE_3, RATE_4, C_1, C_2, LEFT_1, LEFT_2, LEFT_3, LEFT_4 = (row * LANES for row in range(10))
YIELD, Q, D, S_1, S_2, LARGEST, FASTEST = (row * LANES for row in range(10, 17))
STRESS, X_1, X_2, HARD, SOFT, STEP, TRIED, EXCESS = (row * LANES for row in range(17, 25))
FLOW, LOW, HIGH, OPEN, SINGLE, CLOSE_TO = (row * LANES for row in range(25, 31))
ROWS = 31


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _onward(e, r_1, r_2, r_3, r_4, c_1, c_2, c_3, c_4, single):  # type: ignore[no-untyped-def]
    """How much further d goes from where c_k is left to saturate; single : e has one zero, however it is found"""
    m_1, m_2, m_3, m_4 = r_1 * c_1, r_2 * c_2, r_3 * c_3, r_4 * c_4
    slope = 1.0 + ((m_1 + m_2) + (m_3 + m_4))
    m_1, m_2, m_3, m_4 = r_1 * m_1, r_2 * m_2, r_3 * m_3, r_4 * m_4
    second = (m_1 + m_2) + (m_3 + m_4)
    third = (r_1 * m_1 + r_2 * m_2) + (r_3 * m_3 + r_4 * m_4)
    per_slope = 1.0 / max(slope, STEEPEST)
    newton = e * per_slope
    share = newton * per_slope
    bent, twisted = (1.0 / 2.0) * second * share, (1.0 / 6.0) * third * share * newton
    wider = (1.0 - bent) / ((1.0 - bent) - bent + twisted)
    return newton * min(max(wider, 1.0 / WIDEST), WIDEST) if single else newton


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _begun(s):  # type: ignore[no-untyped-def]
    """The stress if nothing flows, what of it is in excess, and a first guess of d."""
    for j in range(min(LANES, s.size)):
        rising = s[STEP + j] >= 0.0
        width = abs(s[STEP + j])
        tried = width + (s[STRESS + j] if rising else -s[STRESS + j])
        x_1, x_2 = s[X_1 + j] if rising else -s[X_1 + j], s[X_2 + j] if rising else -s[X_2 + j]
        c_1, c_2 = s[S_1 + j] - x_1, s[S_2 + j] - x_2
        c_3, c_4 = s[Q + j] * s[HARD + j], -s[D + j] * s[SOFT + j]
        size = s[YIELD + j] + (s[Q + j] - c_3) - (s[D + j] + c_4)
        e = (tried - x_1 - x_2) - size
        r_1, r_2, r_3, r_4 = s[RATE_1 + j], s[RATE_2 + j], s[RATE_3 + j], s[RATE_4 + j]
        single = 1.0 + (r_3 * min(c_3, 0.0) + r_4 * min(c_4, 0.0)) >= STEEPEST
        guess = _onward(e, r_1, r_2, r_3, r_4, c_1, c_2, c_3, c_4, single)
        s[C_1 + j], s[C_2 + j], s[TRIED + j], s[EXCESS + j] = c_1, c_2, tried, e
        s[LEFT_1 + j], s[LEFT_2 + j], s[LEFT_3 + j], s[LEFT_4 + j] = c_1, c_2, s[HARD + j], s[SOFT + j]
        s[FLOW + j], s[LOW + j], s[HIGH + j] = guess if e > 0.0 else 0.0, 0.0, np.inf
        s[OPEN + j] = 1.0 if e > 0.0 else 0.0
        s[SINGLE + j] = 1.0 if single else 0.0
        s[CLOSE_TO + j] = CLOSE * width + ROUNDING * s[LARGEST + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _fall(x):  # type: ignore[no-untyped-def]
    """1 - exp(-x) to x^3."""
    return x * (1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0)))


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(s):  # type: ignore[no-untyped-def]
    """One step of d in every open lane, which is closed where it leaves no excess."""
    for j in range(min(LANES, s.size)):
        flow, opened = s[FLOW + j], s[OPEN + j] > 0.0
        r_1, r_2, r_3, r_4 = s[RATE_1 + j], s[RATE_2 + j], s[RATE_3 + j], s[RATE_4 + j]
        along = -TO_BASE_2 * flow
        c_1, c_2 = s[C_1 + j] * power_of_2(r_1 * along), s[C_2 + j] * power_of_2(r_2 * along)
        hard, soft = s[HARD + j] * power_of_2(r_3 * along), s[SOFT + j] * power_of_2(r_4 * along)
        c_3, c_4 = s[Q + j] * hard, -s[D + j] * soft
        saturated = s[Q + j] * (s[HARD + j] - hard) - s[D + j] * (s[SOFT + j] - soft)
        e = (s[EXCESS + j] - flow) - (((s[C_1 + j] - c_1) + (s[C_2 + j] - c_2)) + saturated)
        low, high = flow if e > 0.0 else s[LOW + j], s[HIGH + j] if e > 0.0 else flow
        new = flow + _onward(e, r_1, r_2, r_3, r_4, c_1, c_2, c_3, c_4, s[SINGLE + j] > 0.0)
        new = new if (new >= low) & (new <= high) else 0.5 * (low + high)
        on = new - flow
        x_1, x_2, x_3, x_4 = r_1 * on, r_2 * on, r_3 * on, r_4 * on
        fall_1, fall_2, fall_3, fall_4 = c_1 * _fall(x_1), c_2 * _fall(x_2), _fall(x_3), _fall(x_4)
        left = (e - on) - ((fall_1 + fall_2) + (c_3 * fall_3 + c_4 * fall_4))
        y_1, y_2, y_3, y_4 = x_1 * x_1, x_2 * x_2, x_3 * x_3, x_4 * x_4
        # the rest of the series to the right of 0, by the next power
        rest = (abs(c_1) * y_1 * y_1 + abs(c_2) * y_2 * y_2) + (abs(c_3) * y_3 * y_3 + abs(c_4) * y_4 * y_4)
        near = abs(left) + (1.0 / 8.0) * rest <= s[CLOSE_TO + j]
        found = near & (on * s[FASTEST + j] >= -FARTHEST_BACK)
        s[LOW + j], s[HIGH + j], s[FLOW + j] = low, high, new if opened else flow
        s[LEFT_1 + j] = (c_1 - fall_1 if found else c_1) if opened else s[LEFT_1 + j]
        s[LEFT_2 + j] = (c_2 - fall_2 if found else c_2) if opened else s[LEFT_2 + j]
        s[LEFT_3 + j] = (hard - hard * fall_3 if found else hard) if opened else s[LEFT_3 + j]
        s[LEFT_4 + j] = (soft - soft * fall_4 if found else soft) if opened else s[LEFT_4 + j]
        s[OPEN + j] = 0.0 if found else s[OPEN + j]


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _kept(s):  # type: ignore[no-untyped-def]
    """What was found becomes the state."""
    for j in range(min(LANES, s.size)):
        rising = s[STEP + j] >= 0.0
        stress, x_1, x_2 = s[TRIED + j] - s[FLOW + j], s[S_1 + j] - s[LEFT_1 + j], s[S_2 + j] - s[LEFT_2 + j]
        s[STRESS + j] = stress if rising else -stress
        s[X_1 + j], s[X_2 + j] = x_1 if rising else -x_1, x_2 if rising else -x_2
        s[HARD + j], s[SOFT + j] = s[LEFT_3 + j], s[LEFT_4 + j]


@njit(forceinline=True, error_model="numpy")
def _going(s):  # type: ignore[no-untyped-def]
    """How many lanes are open."""
    going = 0
    for j in range(min(LANES, s.size)):
        going += 1 if s[OPEN + j] > 0.0 else 0
    return going


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def flowed_together(s: Array) -> None:
    """The state of a group after strains of s[STEP:], over Young's modulus."""
    _begun(s)
    for _ in range(MOST_STEPS):
        if _going(s) == 0:
            break
        _advanced(s)
    _kept(s)


@njit(cache=True, error_model="numpy")
def _grouped(parameters: Array, first: int, used: int) -> Array:
    """A group of unstrained particles, the `first` to the `used` that follow and copies of the last."""
    s = np.zeros(ROWS * LANES)
    for j in range(LANES):
        p = parameters[:, first + min(j, used - 1)]
        s[YIELD + j], s[Q + j], s[D + j], s[S_1 + j], s[S_2 + j] = (
            p[one.YIELD],
            p[one.Q],
            p[one.D],
            p[one.S_1],
            p[one.S_2],
        )
        s[RATE_1 + j], s[RATE_2 + j], s[RATE_3 + j], s[RATE_4 + j] = p[one.GAMMA_1], p[one.GAMMA_2], p[one.B], p[one.A]
        s[LARGEST + j] = p[one.YIELD] + abs(p[one.Q]) + abs(p[one.D]) + p[one.S_1] + p[one.S_2]
        s[FASTEST + j] = max(p[one.GAMMA_1], p[one.GAMMA_2], p[one.B], p[one.A])
        s[HARD + j] = s[SOFT + j] = 1.0
    return s


@njit(cache=True, error_model="numpy")
def metal_plasticity(u: Array, parameters: Array) -> Array:
    """Stress over Young's modulus.

    u : float64[samples, 1] or float64[samples, swarm]    strain, any unit
    parameters : float64[9, swarm]    yield > 0, unit of u; Q; b >= 0, 1 / unit of u; D; a >= 0; S_1 >= 0, unit of u;
        gamma_1 >= 0, 1 / unit of u; S_2; gamma_2; Q and D in the unit of u, yield + Q - D > 0
    -> float64[samples, swarm]        unit of u, 0 at the first sample
    """
    samples, columns = u.shape
    swarm = parameters.shape[1]
    out = np.zeros((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = _grouped(parameters, first, used)
        for i in range(1, samples):
            for j in range(LANES):
                column = first + min(j, used - 1) if columns > 1 else 0
                s[STEP + j] = u[i, column] - u[i - 1, column]
            flowed_together(s)
            for j in range(used):
                out[i, first + j] = s[STRESS + j]
    return out

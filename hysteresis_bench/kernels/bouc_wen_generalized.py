"""Generalized Bouc-Wen hysteresis of a swarm: `bouc_wen_generalized_step` has the law and its step for one particle.

Here LANES particles make that step side by side, those that yield after a like displacement together, as they want as
many parts of an increment: five times as fast for a swarm of fifty.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import SERIES_LIMIT, series
from hysteresis_bench.kernels.bouc_wen_generalized_step import FINE, LEAST, MOST_STEPS
from hysteresis_bench.kernels.elementary import exponential, logarithm

LANES = 8
"""Particles side by side; a swarm is padded to a multiple with copies of its last particle."""

# Rows of a group: the parameters, then the state z and E, the increment, and what the steps of one share.
YIELD, POWER, BETA, PHI, STRENGTH, STIFFNESS, PINCHING, GROWTH, PLACE, WIDTH = (row * LANES for row in range(10))
STATE, ENERGY, STEP, PART, STEPS, G = (row * LANES for row in range(10, 16))
ROWS = 16


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _coefficients(g, largest, along, against, n, a, pinching, place, width):  # type: ignore[no-untyped-def]
    """a and b of dg/dw = a - b g;  largest : of |g| in the step."""
    share = (g - place) / width
    h = max(1.0 - pinching * exponential(-share * share), LEAST)
    size = abs(g)
    power = exponential((n - 1.0) * logarithm(size))
    unloading = -min(against * power, (1.0 - LEAST) / largest)
    return a * h, a * h * (along * power if g >= 0.0 else unloading)


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _relaxed(g, a, b, width):  # type: ignore[no-untyped-def]
    x = b * width
    weakened = width * series(x) if abs(x) <= SERIES_LIMIT else (1.0 - exponential(-max(x, -50.0))) / b
    return g + (a - b * g) * weakened


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def strained_together(s: Array) -> None:
    """z and E of a group after the input has gone on by s[STEP:]."""
    most = 1.0
    for j in range(LANES):
        step = s[STEP + j]
        width = abs(step)
        steps = min(np.floor(width / (FINE * s[YIELD + j])) + 1.0, MOST_STEPS)
        s[PART + j] = width / steps
        s[STEPS + j] = steps if step != 0.0 else 0.0
        s[G + j] = s[STATE + j] if step >= 0.0 else -s[STATE + j]
        most = max(most, steps)
    for k in range(int(most)):
        for j in range(LANES):
            g, energy, width, n = s[G + j], s[ENERGY + j], s[PART + j], s[POWER + j]
            nu = min(max(1.0 + s[STRENGTH + j] * energy, LEAST), 1.0 / LEAST)
            eta = min(max(1.0 + s[STIFFNESS + j] * energy, LEAST), 1.0 / LEAST)
            phi = s[PHI + j] if s[STEP + j] >= 0.0 else -s[PHI + j]
            along, against = nu * (1.0 + 2.0 * phi), nu * (1.0 - 2.0 * s[BETA + j])
            bound = exponential(logarithm(along) / -n)
            pinching = s[PINCHING + j] * (1.0 - exponential(-s[GROWTH + j] * energy))
            place, narrow, stiff = s[PLACE + j] * bound, s[WIDTH + j], 1.0 / (eta * s[YIELD + j])
            a, b = _coefficients(g, abs(g), along, against, n, stiff, pinching, place, narrow)
            edge = max(bound, g)
            middle = min(_relaxed(g, a, b, 0.5 * width), edge)
            largest = max(abs(g), abs(middle))
            a, b = _coefficients(middle, largest, along, against, n, stiff, pinching, place, narrow)
            new = min(_relaxed(g, a, b, width), edge)
            going = k < s[STEPS + j]
            s[ENERGY + j] = max(energy + 0.5 * (g + new) * width, 0.0) if going else energy
            s[G + j] = new if going else g
    for j in range(LANES):
        s[STATE + j] = s[G + j] if s[STEP + j] >= 0.0 else -s[G + j]


@njit(cache=True, error_model="numpy")
def bouc_wen_generalized(u: Array, parameters: Array) -> Array:
    """z of a swarm.

    u : float64[samples, 1] or float64[samples, swarm]    input, any unit
    parameters : float64[10, swarm]    yield > 0 in the unit of u; n >= 1; 0 <= beta <= 1; |phi| < 1/2; delta_nu and
        delta_eta, 1 / unit of u; 0 <= zeta < 1; p >= 0, 1 / unit of u; q; width > 0
    -> float64[samples, swarm]         0 at the first sample
    """
    samples, columns = u.shape
    swarm = parameters.shape[1]
    alike = np.argsort(parameters[0])
    out = np.zeros((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        for j in range(LANES):
            for row in range(10):
                s[row * LANES + j] = parameters[row, alike[first + min(j, used - 1)]]
        for i in range(1, samples):
            for j in range(LANES):
                column = alike[first + min(j, used - 1)] if columns > 1 else 0
                s[STEP + j] = u[i, column] - u[i - 1, column]
            strained_together(s)
            for j in range(used):
                out[i, alike[first + j]] = s[STATE + j]
    return out

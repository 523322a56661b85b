"""Generalized Bouc-Wen hysteresis of a swarm: `bouc_wen_generalized_step` has the law and its step for one particle.

Here LANES particles make that step side by side, those that yield after a like displacement together, as they want as
many parts of an increment.
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

# Rows of a group: the parameters, then the state z and E, the increment, and what its steps share.
YIELD, POWER, BETA, PHI, STRENGTH, STIFFNESS, PINCHING, GROWTH, PLACE, WIDTH = (row * LANES for row in range(10))
STATE, ENERGY, STEP, LEFT, G = (row * LANES for row in range(10, 15))
ALONG, AGAINST, BOUND, PINCHED, STIFF = (row * LANES for row in range(15, 20))
ROWS = 20


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


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _begun(s):  # type: ignore[no-untyped-def]
    """What the steps of an increment share."""
    for j in range(min(LANES, s.size)):
        step, energy = s[STEP + j], s[ENERGY + j]
        left = abs(step)
        g = s[STATE + j] if step >= 0.0 else -s[STATE + j]
        ahead = min(g + 0.5 * left / s[YIELD + j], 1.0)
        between = max(energy + 0.25 * (g + ahead) * left, 0.0)
        nu = min(max(1.0 + s[STRENGTH + j] * between, LEAST), 1.0 / LEAST)
        eta = min(max(1.0 + s[STIFFNESS + j] * between, LEAST), 1.0 / LEAST)
        phi = s[PHI + j] if step >= 0.0 else -s[PHI + j]
        along = nu * (1.0 + 2.0 * phi)
        s[LEFT + j], s[G + j], s[ALONG + j] = left, g, along
        s[AGAINST + j] = nu * (1.0 - 2.0 * s[BETA + j])
        s[BOUND + j] = exponential(logarithm(along) / -s[POWER + j])
        s[PINCHED + j] = s[PINCHING + j] * (1.0 - exponential(-s[GROWTH + j] * between))
        s[STIFF + j] = 1.0 / (eta * s[YIELD + j])


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _advanced(s, last):  # type: ignore[no-untyped-def]
    """One step of every lane, of no length where nothing is left."""
    for j in range(min(LANES, s.size)):
        g, left, n, stiff = s[G + j], s[LEFT + j], s[POWER + j], s[STIFF + j]
        along, against, bound, pinched = s[ALONG + j], s[AGAINST + j], s[BOUND + j], s[PINCHED + j]
        place, narrow = s[PLACE + j] * bound, s[WIDTH + j]
        a, b = _coefficients(g, abs(g), along, against, n, stiff, pinched, place, narrow)
        steepest = max(abs(a - b * g), stiff if g < 0.0 else 0.0)
        width = left if last | (steepest * left <= FINE) else FINE / steepest
        edge = max(bound, g)
        middle = min(_relaxed(g, a, b, 0.5 * width), edge)
        largest = max(abs(g), abs(middle))
        a, b = _coefficients(middle, largest, along, against, n, stiff, pinched, place, narrow)
        new = min(_relaxed(g, a, b, width), edge)
        s[ENERGY + j] = max(s[ENERGY + j] + 0.5 * (g + new) * width, 0.0)
        s[G + j] = new
        s[LEFT + j] = left - width


@njit(forceinline=True, error_model="numpy")
def _going(s):  # type: ignore[no-untyped-def]
    """How many lanes have something left."""
    going = 0
    for j in range(min(LANES, s.size)):
        going += 1 if s[LEFT + j] > 0.0 else 0
    return going


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def strained_together(s: Array) -> None:
    """z and E of a group after the input has gone on by s[STEP:]."""
    _begun(s)
    for step in range(1, MOST_STEPS + 1):
        _advanced(s, step == MOST_STEPS)
        if _going(s) == 0:
            break
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

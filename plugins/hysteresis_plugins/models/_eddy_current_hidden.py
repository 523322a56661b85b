"""Eddy currents around any law as a whole, for made data: without the kernels that solve them inside a law."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Hiding, Response
from hysteresis_plugins.effects._hidden import longest_lag

AGREES = 1e-6
"""The acting input is found when it changes by less than this share of its range from one round to the next."""
MOST_ROUNDS = 400


def relaxed(inner: Response, u: Array, coefficient: float, step: float) -> Array:
    """y = F[z] with z = u - coefficient dy/dt, backward Euler, by waveform relaxation [1] of the whole record.

    Every round solves z + coefficient S dz/dt = u - coefficient d(F[z'] - S z')/dt with the z' of the round before.
    S is the steepest slope of F, so that a law that rises everywhere contracts. Raises ValueError for another law:
    where it falls, the equation has no solution that depends continuously on the input.

    inner : F;  u : (samples,);  coefficient : unit of u times time over output;  step : time between samples

    [1] E. Lelarasmee, A. E. Ruehli, A. L. Sangiovanni-Vincentelli, IEEE Trans. CAD 1 (1982) 131.
    """
    from scipy.signal import lfilter

    steps = np.diff(u)
    moving = np.abs(steps) > 1e-3 * np.max(np.abs(steps))
    steepest = float(np.max(np.diff(inner(u))[moving] / steps[moving]))
    lag = coefficient * steepest / step
    z = u
    for _ in range(MOST_ROUNDS):
        rest = np.diff(inner(z) - steepest * z, prepend=0.0)
        rest[0] = 0.0
        right = u - coefficient / step * rest
        found = lfilter([1.0 / (1.0 + lag)], [1.0, -lag / (1.0 + lag)], right, zi=[lag / (1.0 + lag) * u[0]])[0]
        change, z = float(np.max(np.abs(found - z))), found
        if change < AGREES * np.ptp(u):
            return inner(z)
    raise ValueError("eddy currents cannot be made around a law that falls while its input rises")


def opposed(inner: Response, u: Array, hiding: Hiding) -> Array:
    return relaxed(inner, u, longest_lag(hiding) * hiding.amplitude / hiding.top, hiding.step)

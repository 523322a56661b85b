"""One increment of cyclic plasticity of a metal for one particle: kinematic and isotropic hardening, solved exactly.

With stresses over Young's modulus, s the direction of an increment and p the plastic path, equations of [1, 2]

    stress = s (yield + R(p)) + X_1 + X_2 while it flows,   dX_k = gamma_k (S_k s - X_k) dp,
    R = Q (1 - exp(-b p)) - D (1 - exp(-a p)),

are solved along the path: X_k relaxes towards s S_k, so that only the plastic share of the increment has to be found,
by Newton's method, where the stress that it leaves is the one of the flow.

[1] J. Lemaitre, J.-L. Chaboche, Mechanics of Solid Materials, Cambridge University Press (1990), section 5.4.
[2] A. R. Hartloper, A. de Castro e Sousa, D. G. Lignos, J. Structural Engineering 147 (2021) 04021028.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

CLOSE = 1e-13
"""Excess of stress over the yield, as a share of the strain increment, at which the plastic share counts as found."""
MOST_STEPS = 60
STEEPEST = 0.05
"""Least slope of the excess: where a metal softens faster, the step is not lengthened."""

YIELD, Q, B, D, A, S_1, GAMMA_1, S_2, GAMMA_2 = range(9)
"""Rows of the parameters."""


@njit(cache=True, error_model="numpy")
def flowed(stress: Array, step: float, p: Array) -> float:
    """The stress after a strain of `step`, over Young's modulus.

    stress : float64[4]    the state: stress, X_1, X_2, all over Young's modulus, and the plastic path; written
    p : float64[9]         rows as named above
    """
    s = math.copysign(1.0, step)
    tried = s * stress[0] + abs(step)
    X_1, X_2, path = s * stress[1], s * stress[2], stress[3]
    size = p[YIELD] + p[Q] * -math.expm1(-p[B] * path) - p[D] * -math.expm1(-p[A] * path)
    excess = tried - X_1 - X_2 - size
    if excess <= 0.0:
        stress[0] += step
        return stress[0]
    flow, low, high = 0.0, 0.0, np.inf
    new_1, new_2 = X_1, X_2
    for _ in range(MOST_STEPS):
        new_1 = p[S_1] + (X_1 - p[S_1]) * math.exp(-p[GAMMA_1] * flow)
        new_2 = p[S_2] + (X_2 - p[S_2]) * math.exp(-p[GAMMA_2] * flow)
        hardened, softened = math.exp(-p[B] * (path + flow)), math.exp(-p[A] * (path + flow))
        size = p[YIELD] + p[Q] * (1.0 - hardened) - p[D] * (1.0 - softened)
        excess = tried - flow - new_1 - new_2 - size
        if abs(excess) <= CLOSE * abs(step):
            break
        if excess > 0.0:
            low = flow
        else:
            high = flow
        slope = 1.0 + p[GAMMA_1] * (p[S_1] - new_1) + p[GAMMA_2] * (p[S_2] - new_2)
        slope += p[Q] * p[B] * hardened - p[D] * p[A] * softened
        flow += excess / max(slope, STEEPEST)
        if not low < flow < high:
            flow = 0.5 * (low + high)
    stress[0] = s * (tried - flow)
    stress[1] = s * new_1
    stress[2] = s * new_2
    stress[3] = path + flow
    return stress[0]

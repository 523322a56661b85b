"""The inverse of a Bouc-Wen model, for a whole signal and one sample at a time.

[1] The PEA paper, equation (14):  u0 = (u + h) / d,  dh/dt = alpha d u0' - beta |u0'| |h|^(n-1) h - gamma u0' |h|^n.

What (14) inverts. By the paper's words u0 is the reference and u the compensated input. Read so, (14) solved for
u is u = d u0 - h with h driven by u0: equation (1), the forward model of the reference, and no inverse at all. With
the names exchanged (u the reference, u0 the voltage) it is the exact inverse of (1) in continuous time, and
implicit: h is driven by the very u0 that is sought. Evaluated with h of the sample before it is late by what h
gains in a sample. Ours: the implicit equation is solved on every sample, with the discrete model's own increment,
so that the forward model returns the reference to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from hysteresis_bench.arrays import Array

LEAST_DISSIPATION = 1e-4
"""Least beta / (beta + gamma). A reversal magnifies a difference of h by about (beta + gamma) / (2 beta); at beta = 0
the saturated h is an unstable equilibrium, below it h has no bound. A loop with so small a beta has no width."""


class Point(NamedTuple):
    """Where a Bouc-Wen model is: its input and its hysteresis."""

    u: float
    h: float


@dataclass(frozen=True)
class BoucWenInverse:
    """The inverse of Bouc-Wen with these parameters; symbols as in the model `bouc-wen`.

    Raises ValueError that tells everything that stands against an inverse.
    """

    alpha: float
    beta: float
    gamma: float
    d: float
    n: float = 1.0

    def __post_init__(self) -> None:
        found = self._faults()
        if found:
            raise ValueError(" ".join(found))

    def _faults(self) -> list[str]:
        if not np.isfinite([self.alpha, self.beta, self.gamma, self.d, self.n]).all():
            return ["No inverse: a parameter is not finite."]
        rate = self.beta + self.gamma
        found = []
        if self.d <= 0.0:
            found.append(f"No inverse: d = {self.d:g} must be above 0.")
        if self.alpha < 0.0:
            found.append(f"No inverse: alpha = {self.alpha:g} must not be negative.")
        if self.alpha > 0.0 and rate <= 0.0:
            found.append(f"No inverse: beta + gamma = {rate:g} must be above 0, else h has no bound.")
        elif self.alpha > 0.0 and self.beta < LEAST_DISSIPATION * rate:
            found.append(
                f"No usable inverse: beta = {self.beta:g} must be above {LEAST_DISSIPATION:g} (beta + gamma), else the "
                f"smallest error of h grows exponentially on a reversal."
            )
        elif self.alpha > 0.0 and self.steepest >= 1.0:
            found.append(
                f"No inverse: the output is not a monotonic function of the input, because "
                f"alpha max(1, 2 beta / (beta + gamma)) = {self.steepest:.4g}; it must be below 1."
            )
        return found

    @property
    def steepest(self) -> float:
        """The largest dh/du as a share of d. Below 1 the output rises with the input everywhere."""
        return self.alpha * max(1.0, 2.0 * self.beta / (self.beta + self.gamma))

    @property
    def _parameters(self) -> tuple[float, float, float, float, float]:
        return self.alpha, self.beta, self.gamma, self.d, float(self.n)

    def input_for(self, v: Array) -> Array:
        """The input whose output is v, from h = 0 at the first sample; v : (samples,) -> (samples,)."""
        from hysteresis_bench.kernels.bouc_wen_inverse import invert

        return invert(np.asarray(v, dtype=float), *self._parameters)

    def towards(self, point: Point, v: float) -> Point:
        """The next point, where the output is v."""
        from hysteresis_bench.kernels.bouc_wen_inverse import inverted

        return Point(*inverted(point.u, point.h, v, *self._parameters))

    def moved(self, point: Point, u: float) -> Point:
        """The next point, where the input is u."""
        from hysteresis_bench.kernels.bouc_wen_step import moved

        return Point(u, moved(point.h, u - point.u, self.alpha * self.d, self.beta, self.gamma, self.n, np.inf))

    def output(self, point: Point) -> float:
        """[1] eq. (1): v = d u - h."""
        return self.d * point.u - point.h
